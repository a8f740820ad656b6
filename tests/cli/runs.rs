//! What `raypacket bench` keeps of a run: rays, and figures to compare with and to draw.

use super::{folder, names, raypacket};
use serde_json::Value;
use std::fs;

fn parse(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

/// Rays and hits of a query at x8.
fn counts(report: &Value, query: &str) -> [u64; 2] {
    let rows = report["results"].as_array().unwrap();
    let row = rows.iter().find(|row| row["query"] == query && row["kernel"] == "x8").expect("a row");
    ["rays", "hits"].map(|key| row[key].as_u64().unwrap())
}

#[test]
fn saved_rays_are_the_rays_of_the_picture() {
    let folder = folder();
    let bench = |args: &str| {
        let args = format!("bench good.toml --size 40x20 --threads 1 --seconds 0 --json a.json {args}");
        let text = raypacket(folder.path(), &args).good().stdout;
        (text, parse(&fs::read_to_string(folder.path().join("a.json")).unwrap()))
    };
    let (text, report) = bench("--save-rays rays");
    let kinds = ["primary", "shadow", "reflection"];
    assert_eq!(names(&folder.path().join("rays")), ["good.primary", "good.reflection", "good.shadow"], "no glass");
    for kind in kinds {
        let [rays, hits] = counts(&report, kind);
        assert!(rays > 0 && hits > 0, "{kind}");
        let line = text.lines().find(|line| line.starts_with("saved ") && line.contains(&format!("good.{kind}: ")));
        assert!(line.is_some_and(|line| line.ends_with(&format!(": {rays} rays"))), "{text}");
        let (_, again) = bench(&format!("--rays rays/good.{kind}"));
        assert_eq!(counts(&again, &format!("rays:{kind}")), [rays, hits], "{kind}");
    }
    raypacket(folder.path(), "bench classic classic --save-rays twice").failed(2, &["two scenes", "classic.primary"]);
    assert_eq!(names(folder.path()), ["a.json", "good.toml", "rays"]);
}

#[test]
fn a_run_against_itself_and_against_a_faster_one() {
    let folder = folder();
    let bench =
        |args: &str| raypacket(folder.path(), &format!("bench good.toml --size 32x16 --threads 1 --seconds 0 {args}"));
    let first = bench("--json a.json").good().stdout;
    assert!(!first.contains("against"), "{first}");
    let report = parse(&fs::read_to_string(folder.path().join("a.json")).unwrap());
    // A run that cannot be told from anything, one that was far faster, and one of another machine with other rows.
    let edited = |edit: &dyn Fn(&mut Value)| {
        let mut report = report.clone();
        edit(&mut report);
        report["results"].as_array_mut().unwrap().iter_mut().for_each(|row| {
            row["spread"] = 0.01.into();
        });
        fs::write(folder.path().join("b.json"), report.to_string()).unwrap();
    };
    edited(&|report| {
        for row in report["results"].as_array_mut().unwrap() {
            row["mrays_median"] = (1000.0 * row["mrays_median"].as_f64().unwrap()).into();
        }
        report["cpu"] = "a\u{1b}nother".into();
        report["results"][0]["query"] = "gone".into();
    });
    let text = bench("--against b.json --svg b.svg").good().stdout;
    let rows = text.split("against commit ").nth(1).expect("a comparison");
    let slower = rows.lines().filter(|line| line.contains("  slower")).count();
    assert_eq!(slower, report["results"].as_array().unwrap().len() - 1, "{text}");
    for line in ["only before: good gone x1", "only now: good primary x1", "warning: other CPU: a?nother before, "] {
        assert!(rows.lines().any(|l| l.starts_with(line)), "no {line:?} in {text}");
    }
    let svg = fs::read_to_string(folder.path().join("b.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>") && svg.contains("slower"), "{svg}");
    edited(&|_| ());
    let text = bench("--against b.json --json c.json").good().stdout;
    let rows = text.split("against commit ").nth(1).expect("a comparison");
    let compared = rows.lines().filter(|line| line.starts_with("good  ")).count();
    assert_eq!(compared, report["results"].as_array().unwrap().len(), "{text}");
    assert!(!rows.contains("only ") && !rows.contains("warning"), "{text}");
    assert_eq!(names(folder.path()), ["a.json", "b.json", "b.svg", "c.json", "good.toml"]);
}

#[test]
fn rates_as_a_chart() {
    let folder = folder();
    raypacket(folder.path(), "bench good.toml --size 32x16 --threads 1 --seconds 0 --svg a.svg").good();
    let svg = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{svg}");
    for words in ["Rays a second", "good, 32 × 16, 1 thread", "primary", "shadow", "x8"] {
        assert!(svg.contains(words), "no {words:?}");
    }
}

#[test]
fn earlier_runs_that_are_none() {
    let folder = folder();
    for (text, words) in [
        ("", "no JSON of `bench --json`"),
        ("{\"scene\":", "no JSON of `bench --json`"),
        ("[]", "an empty array"),
        ("{\"scene\":\"s\"}", "size: is missing"),
        ("[{\"size\":[1,-1]}]", "[0].size[1]: must be a whole number"),
    ] {
        fs::write(folder.path().join("bad.json"), text).unwrap();
        raypacket(folder.path(), "bench --against bad.json --json a.json").failed(2, &["bad.json: ", words]);
    }
    fs::write(folder.path().join("bad.json"), [0xff, 0xfe]).unwrap();
    for (args, words) in [
        ("--against bad.json", "bad.json: "),
        ("--against no.json", "no.json: "),
        ("--against .", "not a regular file"),
        ("--against bad.json --json -", "--against prints"),
    ] {
        raypacket(folder.path(), &format!("bench {args}")).failed(2, &[words]);
    }
    assert_eq!(names(folder.path()), ["bad.json", "good.toml"]);
}
