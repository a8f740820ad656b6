//! Faults near the beginning of a long text, found in little memory: what is wrong with a large file, or is no scene at all,
//! mostly shows in its first lines, while parsing takes some fifty times the memory of what is parsed.

use std::ops::Range;

use toml::de::DeTable;

use super::file::SceneFile;
use super::value::Misfit;

/// The first part that is looked at by itself. Each is [`LONGER`] times as long as the one before.
const FIRST: usize = 64 << 10;
const LONGER: usize = 8;

/// A fault of a part of a text.
pub(super) enum Fault {
    /// In the text as TOML.
    Syntax(toml::de::Error),
    /// A key that is unknown, or a value of the wrong type.
    Shape(Misfit),
}

/// A fault that shows in a part of the text from its beginning, with that part. All parts together are less than a third of
/// the text; so this is what a sound scene pays.
pub(super) fn fault(text: &str) -> Option<(&str, Fault)> {
    let lengths = std::iter::successors(Some(FIRST), |length| Some(length * LONGER));
    let parts = lengths.take_while(|length| *length <= text.len() / 4).map(|length| &text[..boundary(text, length)]);
    parts.into_iter().find_map(|part| in_part(part).map(|fault| (part, fault)))
}

/// The last place between two characters up to a length.
fn boundary(text: &str, length: usize) -> usize {
    (0..=length).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// A fault of a part that is none of being cut off: what that makes is noticed where the last word of the part ends.
fn in_part(part: &str) -> Option<Fault> {
    let before_the_end = |span: &Range<usize>| part.get(span.end..).is_some_and(goes_on);
    if let Err(error) = DeTable::parse(part)
        && error.span().is_some_and(|span| before_the_end(&span))
    {
        return Some(Fault::Syntax(error));
    }
    let (table, _) = DeTable::parse_recoverable(part);
    // A value that is cut off may stand nowhere.
    let counts = |misfit: &Misfit| misfit.missing.is_none() && !misfit.span.is_empty() && before_the_end(&misfit.span);
    SceneFile::read(table.into_inner()).err().filter(counts).map(Fault::Shape)
}

/// Whether there is more than blanks and comments.
fn goes_on(mut rest: &str) -> bool {
    loop {
        rest = rest.trim_start();
        match rest.strip_prefix('#') {
            Some(comment) => rest = comment.split_once('\n').map_or("", |(_, next)| next),
            None => return !rest.is_empty(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::builtins;

    const KEYS: &str = "camera = { eye = [0, 1, 6], fov = 60 } # [\n\n# a comment = [\nlight = [{ position = [3, 5, 4], power = \
        [1, 2, 3] },\n# between\n\n{ position = [-4.5e0, 0x2, 1_0], power = [1, 1, +0.0] }, ]\nsky.image = '''\na'b\n''' \n\
        [materials]\n\"a \\u00e9\".checker = { colors = [[1, 1, 1], [0, 0, 0]], size = 0.25 } # é\n\
        b.texture = \"\"\"x\\\n  y\"\"\"\n[settings]\nattenuation = false\nmax_depth = 7\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n\
        [[sphere]] # more\n  radius\t=\t2\n  center = [\n 1,\n 2, # two\n 3\n ]\nmaterial = 'b'\n";

    /// Wherever a sound scene is cut off.
    #[test]
    fn what_is_cut_off_is_no_fault() {
        let short = |text: &'static str| &text[..boundary(text, text.len().min(2500))];
        for text in builtins().iter().map(|builtin| short(builtin.source)).chain([KEYS]) {
            for end in (0..=text.len()).filter(|end| text.is_char_boundary(*end)) {
                let part = &text[..end];
                match in_part(part) {
                    None => {}
                    Some(Fault::Syntax(error)) => panic!("{error} in {part}"),
                    Some(Fault::Shape(misfit)) => panic!("{misfit:?} in {part}"),
                }
            }
        }
    }

    #[test]
    fn faults_before_the_end_are_found() {
        for wrong in [
            "{\"a\": [1, 2]}",
            "a,b,c\n1,2,3\n",
            "x = [0, 0, 0, 0",
            "[[ball]]\nradius = 1",
            "camera.fov = 'a'\n",
            "sphere = [{ radius = [1] },",
        ] {
            let text = format!("{wrong}\n[[sphere]]\nradius = 2\ncenter = [0");
            assert!(in_part(&text).is_some(), "{text}");
        }
    }

    /// The parts are as long as may be, and not too long for the text.
    #[test]
    fn long_texts_are_looked_at_in_parts() {
        let sound = "sphere = [\n".to_owned() + &"{center=[0,0,0],radius=1},\n".repeat(200_000);
        assert!(fault(&sound).is_none());
        let wrong = sound.replacen("radius=1", "radios=1", 30_000).replacen("radios=1", "radius=1", 29_999);
        assert!(fault(&wrong).is_none(), "beyond the last part");
        let wrong = sound.replacen("radius=1", "radios=1", 3_000).replacen("radios=1", "radius=1", 2_999);
        let (part, _) = fault(&wrong).expect("a fault");
        assert_eq!(part.len(), FIRST * LONGER);
    }
}
