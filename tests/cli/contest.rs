//! `raypacket contest`: the block, and the lines that it keeps.

use super::{add_many, folder, names, raypacket};
use serde_json::Value;
use std::fs;

/// Adds nothing to the time of the tests; and so it is not the contest.
const SMALL: &str = "--size 24x16 --frames 3 --threads 2 --seconds 0";

#[test]
fn the_block_and_its_lines() {
    let folder = folder();
    add_many(folder.path());
    let args = format!("contest good.toml many.toml {SMALL} --append runs.jsonl");
    let text = raypacket(folder.path(), &args).good().stdout;
    for words in
        ["raypacket contest\ncpu ", "\nbuild ", "commit ", "\ndate ", ", once around, x8: not the contest's size\n"]
    {
        assert!(text.contains(words), "no {words:?} in {text}");
    }
    for scene in ["good", "many"] {
        let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        let rows: Vec<_> = rows.iter().filter(|row: &&Vec<&str>| row.first() == Some(&scene)).collect();
        let threads: Vec<&str> = rows.iter().map(|row| row[1]).collect();
        assert_eq!(threads, ["1", "2", "answers"], "{text}");
        assert!(
            rows[..2].iter().all(|row| row[2..6].iter().all(|n| n.parse::<f64>().is_ok_and(|n| n > 0.0))),
            "{text}"
        );
    }
    raypacket(folder.path(), &args).good();
    let lines = fs::read_to_string(folder.path().join("runs.jsonl")).unwrap();
    let entries: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let scenes: Vec<&str> = entries.iter().map(|entry| entry["scene"].as_str().unwrap()).collect();
    assert_eq!(scenes, ["good", "many", "good", "many"]);
    for entry in &entries {
        assert_eq!(entry["size"], serde_json::json!([24, 16]));
        assert_eq!((&entry["frames"], &entry["kernel"]), (&3.into(), &"x8".into()), "{entry}");
        assert_eq!((&entry["valid"], &entry["standard"]), (&true.into(), &false.into()), "{entry}");
        assert_eq!(entry["isa"], raypacket::math::isa());
        assert!(entry["cpu"].is_string() && entry["commit"].is_string() && entry["date"].is_string(), "{entry}");
        assert!(text.contains(entry["digest"].as_str().unwrap()), "{entry} {text}");
        for (i, row) in entry["results"].as_array().unwrap().iter().enumerate() {
            assert_eq!(row["threads"], i + 1);
            for key in ["fps_median", "fps_best", "mrays_median", "ns_per_pixel"] {
                assert!(row[key].as_f64().is_some_and(|n| n > 0.0), "{key}: {row}");
            }
            assert!(row["spread"].is_number() && row["runs"].is_u64(), "{row}");
        }
    }
    assert_eq!(entries[0]["digest"], entries[2]["digest"]);
    assert_ne!(entries[0]["digest"], entries[1]["digest"]);
    assert_eq!(names(folder.path()), ["good.toml", "many.toml", "runs.jsonl"]);
}

#[test]
fn one_thread_is_one_row_and_old_lines_stay() {
    let folder = folder();
    fs::write(folder.path().join("runs.jsonl"), "{}\n{\"torn").unwrap();
    let args = "contest --size 16x16 --frames 2 --kernel x4 --threads 1 --seconds 0 --append runs.jsonl";
    let text = raypacket(folder.path(), args).good().stdout;
    assert_eq!(text.lines().filter(|line| line.starts_with("classic")).count(), 2, "{text}");
    let lines = fs::read_to_string(folder.path().join("runs.jsonl")).unwrap();
    assert!(lines.starts_with("{}\n{\"torn\n{\"scene\":\"classic\"") && lines.ends_with("}\n"), "{lines}");
    raypacket(folder.path(), "contest good.toml no.toml --append new.jsonl").failed(2, &["no.toml"]);
    assert_eq!(names(folder.path()), ["good.toml", "runs.jsonl"]);
}
