//! That the house is built as `src/lib.rs` says: who may import whom.
//!
//! A module is a file. It imports another where a path of its code, in a `use` or anywhere else, leads into that file:
//! a path that starts with `crate`, `raypacket`, `super` or `self`, or with the name of a child. The longest part of the
//! path that is a file is what is imported; so `super::X` imports the parent, whoever the parent has X from. Code under
//! `#[cfg(test)]`, files named `tests` or `…_tests` and folders named `tests` do not count.
//!
//! - Between the folders of `src`, imports run downward in the list of `src/lib.rs`; the program is above it.
//! - `reference` imports `scene` and `kinds` only.
//! - Within a folder, no imports make a circle. For this, `pub use` of a file further in does not count: that is how
//!   a folder shows what it holds. Likewise `src/lib.rs` shows what all folders hold.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// What is not in order yet: imports from the first folder to the second run upward, or in circles where both are the
/// same. The lead opens them; there shall be none. One that is no longer needed is a finding as well.
const OPEN: &[(&str, &str)] = &[];

#[test]
fn imports_run_downward_and_not_in_circles() {
    let mut files = Vec::new();
    read(Path::new("src"), &mut files);
    let found = findings(&files, OPEN);
    assert!(found.is_empty(), "\n{}\n", found.join("\n"));
}

/// All sources below a folder: path and text.
fn read(folder: &Path, files: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            read(&path, files);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let name = path.to_string_lossy().replace('\\', "/");
            files.push((name, std::fs::read_to_string(&path).expect("a text")));
        }
    }
    files.sort();
}

/// A word of a source: a name, `::`, or a single sign.
#[derive(Clone, Debug)]
struct Word {
    text: String,
    line: usize,
}

/// What a text consists of, without comments, texts in quotes, and lifetimes.
fn words(text: &str) -> Vec<Word> {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let named = |c: char| c.is_alphanumeric() || c == '_';
    let (mut words, mut i, mut line) = (Vec::new(), 0, 1);
    while i < chars.len() {
        let start = i;
        let to = |end: Option<usize>| end.unwrap_or(chars.len());
        let (end, counts) = match (at(i), at(i + 1)) {
            ('/', '/') => (to((i..chars.len()).find(|&j| at(j) == '\n')), false),
            ('/', '*') => (to((i + 4..=chars.len()).find(|&j| at(j - 2) == '*' && at(j - 1) == '/')), false),
            ('"', _) => (quoted(&chars, i), false),
            ('r', '"' | '#') if raw(&chars, i).is_some() => (to(raw(&chars, i)), false),
            ('\'', '\\') => (to((i + 3..chars.len()).find(|&j| at(j) == '\'').map(|j| j + 1)), false),
            ('\'', _) if at(i + 2) == '\'' => (i + 3, false),
            ('\'', _) => (to((i + 1..chars.len()).find(|&j| !named(at(j)))), false),
            (':', ':') => (i + 2, true),
            (c, _) if named(c) => (to((i..chars.len()).find(|&j| !named(at(j)))), true),
            (c, _) => (i + 1, !c.is_whitespace()),
        };
        i = end.min(chars.len());
        let part: String = chars[start..i].iter().collect();
        line += part.matches('\n').count();
        if counts {
            words.push(Word { text: part, line });
        }
    }
    words
}

/// Where a text in quotes that starts at `i` is over.
fn quoted(chars: &[char], mut i: usize) -> usize {
    i += 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// The same for a raw one, if it is one.
fn raw(chars: &[char], i: usize) -> Option<usize> {
    let hashes = chars[i + 1..].iter().take_while(|&&c| c == '#').count();
    let open = i + 1 + hashes;
    if chars.get(open) != Some(&'"') {
        return None;
    }
    let closes = |j: &usize| chars[*j] == '"' && (1..=hashes).all(|k| chars.get(j + k) == Some(&'#'));
    (open + 1..chars.len()).find(closes).map(|j| j + 1 + hashes)
}

/// Leaves out what stands under `#[cfg(test)]`, and says which files are declared there.
fn without_tests(words: &[Word]) -> (Vec<Word>, Vec<String>) {
    let is = |i: usize, text: &str| words.get(i).is_some_and(|w| w.text == text);
    let test = |i: usize| ["#", "[", "cfg", "(", "test", ")", "]"].iter().enumerate().all(|(k, text)| is(i + k, text));
    let (mut kept, mut files, mut i) = (Vec::new(), Vec::new(), 0);
    while i < words.len() {
        if !test(i) {
            kept.push(words[i].clone());
            i += 1;
            continue;
        }
        i += 7;
        let mut depth = 0;
        while i < words.len() {
            match words[i].text.as_str() {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth -= 1,
                "mod" if is(i + 2, ";") => files.push(words[i + 1].text.clone()),
                _ => {}
            }
            i += 1;
            if depth == 0 && (is(i - 1, ";") || is(i - 1, "}")) {
                break;
            }
        }
    }
    (kept, files)
}

/// A path in the code.
#[derive(Debug)]
struct Way {
    segments: Vec<String>,
    line: usize,
    /// Whether it stands in a `pub use`.
    shown: bool,
}

/// All paths, those in braces one by one.
fn ways(words: &[Word]) -> Vec<Way> {
    let text = |i: usize| words.get(i).map_or("", |w| w.text.as_str());
    let (mut ways, mut i) = (Vec::new(), 0);
    while i < words.len() {
        if text(i) == "use" && text(i + 1) != "<" {
            let shown = i > 0 && (text(i - 1) == "pub" || text(i - 1) == ")");
            i = tree(words, i + 1, &[], shown, &mut ways);
            continue;
        }
        let begins = i == 0 || text(i - 1) != "::";
        let visibility = i > 1 && text(i - 1) == "in" && text(i - 2) == "(";
        let mut segments = vec![text(i).to_owned()];
        while text(i + 1) == "::" && text(i + 2).starts_with(|c: char| c.is_alphabetic() || c == '_') {
            i += 2;
            segments.push(text(i).to_owned());
        }
        if begins && !visibility && segments.len() > 1 {
            ways.push(Way { segments, line: words[i].line, shown: false });
        }
        i += 1;
    }
    ways
}

/// Takes in what `use` brings in, from word `i` on; where it ends.
fn tree(words: &[Word], mut i: usize, before: &[String], shown: bool, ways: &mut Vec<Way>) -> usize {
    let mut segments = before.to_vec();
    let mut line = words.get(i).map_or(0, |w| w.line);
    let mut group = false;
    while let Some(word) = words.get(i) {
        match word.text.as_str() {
            "{" => {
                group = true;
                i += 1;
                while words.get(i).is_some_and(|w| w.text != "}") {
                    i = tree(words, i, &segments, shown, ways);
                    i += usize::from(words.get(i).is_some_and(|w| w.text == ","));
                }
            }
            "," | "}" | ";" => break,
            "as" => i += 1,
            "::" | "*" => {}
            // `self` at the end of a path is what stands before it.
            "self" if !segments.is_empty() => {}
            name => {
                line = word.line;
                segments.push(name.to_owned());
            }
        }
        i += 1;
    }
    if !group && !segments.is_empty() {
        ways.push(Way { segments, line, shown });
    }
    i
}

/// The module that a file is: `a::b` for `src/a/b.rs`, `a` for `src/a/mod.rs`.
fn module(path: &str) -> Vec<String> {
    let inner = path.trim_start_matches("src/").trim_end_matches(".rs");
    let inner = inner.trim_end_matches("/mod");
    if inner == "lib" { Vec::new() } else { inner.split('/').map(str::to_owned).collect() }
}

/// An import from one file to another.
#[derive(Debug)]
struct Import {
    place: String,
    from: Vec<String>,
    to: Vec<String>,
    shown: bool,
}

/// All imports between files that are no tests; the first where there are several alike.
fn imports(files: &[(String, String)]) -> Vec<Import> {
    let mut sources: BTreeMap<Vec<String>, (&str, Vec<Word>)> = BTreeMap::new();
    let mut tests = BTreeSet::new();
    for (path, text) in files {
        let name = module(path);
        let (words, declared) = without_tests(&words(text));
        tests.extend(declared.into_iter().map(|child| [name.clone(), vec![child]].concat()));
        if !name.iter().any(|part| part == "tests" || part.ends_with("_tests")) {
            sources.insert(name, (path, words));
        }
    }
    sources.retain(|name, _| !(1..=name.len()).any(|n| tests.contains(&name[..n])));
    let (mut imports, mut known) = (Vec::new(), BTreeSet::new());
    for (from, (path, words)) in &sources {
        for Way { segments, line, shown } in ways(words) {
            if let Some(to) = file_of(&segments, from, &|name| sources.contains_key(name))
                && to != *from
                && !to.is_empty()
                && known.insert((from.clone(), to.clone(), shown))
            {
                imports.push(Import { place: format!("{path}:{line}"), from: from.clone(), to, shown });
            }
        }
    }
    imports
}

/// The file that a path leads to, as seen from a file.
fn file_of(segments: &[String], from: &[String], exists: &dyn Fn(&[String]) -> bool) -> Option<Vec<String>> {
    let own = if from == ["main"] { &[] } else { from };
    let mut name = match segments[0].as_str() {
        "crate" | "raypacket" => Vec::new(),
        "self" | "super" => own.to_vec(),
        child => {
            let child = [own, &[child.to_owned()]].concat();
            return exists(&child).then(|| furthest(child, &segments[1..], exists));
        }
    };
    let ups = segments.iter().take_while(|s| *s == "super").count();
    name.truncate(name.len().saturating_sub(ups));
    Some(furthest(name, &segments[ups.max(1)..], exists))
}

/// As far as there are files.
fn furthest(mut name: Vec<String>, segments: &[String], exists: &dyn Fn(&[String]) -> bool) -> Vec<String> {
    for segment in segments {
        name.push(segment.clone());
        if !exists(&name) {
            name.pop();
            break;
        }
    }
    name
}

/// The folders from the top to the bottom, as the list in `src/lib.rs` has them, below the program.
fn order(files: &[(String, String)]) -> Vec<String> {
    let lib = files.iter().find(|(path, _)| path == "src/lib.rs").map_or("", |(_, text)| text);
    let house = lib.split("# The house").nth(1).unwrap_or("").lines().take_while(|line| !line.contains("# The rules"));
    let items = house.filter_map(|line| line.strip_prefix("//! - ")?.split('`').nth(1).map(str::to_owned));
    ["main", "cli"].map(str::to_owned).into_iter().chain(items).collect()
}

/// What is not as it should be, each with file and line.
fn findings(files: &[(String, String)], open: &[(&str, &str)]) -> Vec<String> {
    let (imports, order) = (imports(files), order(files));
    let rank = |folder: &str| order.iter().position(|f| f == folder);
    let mut found: Vec<(&str, &str, String)> = Vec::new();
    for Import { place, from, to, shown } in &imports {
        let (above, below) = (from[..].first().map_or("lib", |s| s), to[0].as_str());
        let fault = match (above, below) {
            _ if above == below => continue,
            // The root shows what its folders hold.
            _ if from.is_empty() && *shown => continue,
            ("reference", "scene" | "kinds") => continue,
            ("reference", _) => "shares something with others",
            _ if rank(above).is_none() || rank(below).is_none() => {
                "is not in the list of src/lib.rs, or imports what is not"
            }
            _ if rank(above) < rank(below) => continue,
            _ => "imports from above",
        };
        found.push((above, below, format!("{place}: {} {fault}: {}", from.join("::"), to.join("::"))));
    }
    for (import, way) in circles(&imports) {
        let folder = import.from[0].as_str();
        found.push((folder, folder, format!("{}: a circle: {way}", import.place)));
    }
    let stale = open.iter().filter(|pair| !found.iter().any(|(from, to, _)| (*from, *to) == **pair));
    let stale: Vec<String> = stale.map(|pair| format!("tests/house.rs: {pair:?} is open for nothing")).collect();
    let closed = found.iter().filter(|(from, to, _)| !open.contains(&(*from, *to)));
    closed.map(|(_, _, text)| text.clone()).chain(stale).collect()
}

/// The imports within a folder from where imports lead back, and the way around.
fn circles(imports: &[Import]) -> Vec<(&Import, String)> {
    let counts = |i: &&Import| i.from.first() == i.to.first() && !(i.shown && i.to.starts_with(&i.from));
    let mut next: BTreeMap<&[String], BTreeSet<&[String]>> = BTreeMap::new();
    for import in imports.iter().filter(counts) {
        next.entry(&import.from).or_default().insert(&import.to);
    }
    let around = |import: &Import| {
        let mut before: BTreeMap<&[String], &[String]> = BTreeMap::new();
        let mut reached = vec![&import.to[..]];
        while let Some(at) = reached.pop() {
            for to in next.get(at).into_iter().flatten().filter(|to| **to != &import.to[..]) {
                if !before.contains_key(to) {
                    before.insert(to, at);
                    reached.insert(0, to);
                }
            }
        }
        let mut way = vec![import.from.join("::")];
        let mut at = &import.from[..];
        while at != &import.to[..] {
            at = before.get(at)?;
            way.push(at.join("::"));
        }
        way.push(import.from.join("::"));
        way.reverse();
        Some(way.join(" → "))
    };
    imports.iter().filter(counts).filter_map(|import| Some((import, around(import)?))).collect()
}

/// A made-up house of two floors.
fn house(rooms: &[(&str, &str)]) -> Vec<(String, String)> {
    let list = "//! # The house\n//! - [`up`]: above\n//! - [`down`]: below\n//! - [`scene`]: the description\n\
                //! - [`reference`](mod@reference): apart\n//! # The rules\npub use up::A;\n";
    let rooms = rooms.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned()));
    std::iter::once(("src/lib.rs".to_owned(), list.to_owned())).chain(rooms).collect()
}

#[test]
fn a_sound_house_has_no_findings() {
    let sound = house(&[
        ("src/main.rs", "mod cli;\nfn main() { cli::run(); }"),
        ("src/cli/mod.rs", "use raypacket::up::{self, a::A};\n// use crate::main;\npub(in crate::cli) fn run() {}"),
        ("src/up/mod.rs", "mod a;\nmod b;\npub use a::A;\npub(crate) use b::{B, C as D};\nuse crate::down::Floor;"),
        (
            "src/up/a.rs",
            "use super::b::B;\nlet text = \"crate::cli::run\"; let c = '\"'; r#\"super::\"#; use_it::<'static>();",
        ),
        ("src/up/b.rs", "use crate::down::{self, Floor};\n#[cfg(test)]\nmod tests {\n    use super::super::a::A;\n}"),
        ("src/up/b_tests.rs", "use super::a::A;"),
        ("src/down/mod.rs", "#[cfg(test)]\nmod trial;\npub struct Floor;"),
        ("src/down/trial.rs", "use crate::up::A;"),
        ("src/scene.rs", ""),
        ("src/reference.rs", "use crate::scene;"),
    ]);
    assert_eq!(findings(&sound, &[]), [""; 0]);
}

#[test]
fn what_runs_upward_is_found() {
    let upward = house(&[
        ("src/up.rs", "use crate::cellar::X;"),
        ("src/down.rs", "use std::{fmt, io};\nuse crate::{\n    scene::X,\n    up::{self, Y},\n};"),
        ("src/reference.rs", "use crate::down::X;"),
        ("src/scene.rs", ""),
        ("src/cellar.rs", ""),
    ]);
    let found = findings(&upward, &[]);
    let places = ["src/down.rs:4", "src/reference.rs:1", "src/up.rs:1"];
    assert_eq!(found.len(), places.len(), "{found:#?}");
    for (found, place) in found.iter().zip(places) {
        assert!(found.starts_with(place), "{found}");
    }
    let open = [("down", "up"), ("reference", "down"), ("up", "cellar"), ("up", "down")];
    assert_eq!(findings(&upward, &open), ["tests/house.rs: (\"up\", \"down\") is open for nothing"]);
}

#[test]
fn circles_are_found() {
    let round = house(&[
        ("src/up/mod.rs", "mod a;\nmod b;\nmod c;\nmod d;\npub use d::D;"),
        ("src/up/a.rs", "use super::b::B;"),
        ("src/up/b.rs", "use crate::up::c;"),
        ("src/up/c.rs", "fn f() { super::a::g(); }"),
        ("src/up/d.rs", "use super::{D, a::A};"),
        ("src/down/mod.rs", "mod e;\nuse e::E;\npub struct F;"),
        ("src/down/e.rs", "use super::F;"),
    ]);
    let found = findings(&round, &[]);
    assert_eq!(found.len(), 5, "{found:#?}");
    assert!(found.contains(&"src/up/a.rs:1: a circle: up::a → up::b → up::c → up::a".to_owned()), "{found:#?}");
    assert!(found.contains(&"src/down/mod.rs:2: a circle: down → down::e → down".to_owned()), "{found:#?}");
    assert_eq!(findings(&round, &[("up", "up"), ("down", "down")]), [""; 0]);
}
