//! `raypacket bench` and `raypacket verify`, and the JSON that other programs read.

use super::{Run, add_many, folder, names, raypacket};
use serde_json::Value;
use std::fs;

fn parse(text: &str) -> Value {
    assert_eq!(text.lines().count(), 1, "one line, and nothing beside it: {text}");
    serde_json::from_str(text).expect("JSON")
}

/// Asserts what the design says about one object of `bench --json`.
#[track_caller]
fn check_bench(report: &Value, scene: &str, threads: u64) {
    assert_eq!(report["scene"], scene);
    assert_eq!(report["size"], serde_json::json!([32, 16]));
    assert_eq!(report["threads"], threads);
    assert_eq!(report["isa"], raypacket::math::isa());
    assert_eq!(report["valid"], true);
    let text = |key: &str| report[key].as_str().unwrap_or_else(|| panic!("no {key} in {report}"));
    assert!(!text("cpu").is_empty() && !text("commit").is_empty());
    assert_eq!(text("version"), env!("CARGO_PKG_VERSION"));
    let date: String = text("date").chars().map(|c| if c.is_ascii_digit() { '0' } else { c }).collect();
    assert_eq!(date, "0000-00-00T00:00:00Z");
    for result in report["results"].as_array().expect("results") {
        assert!(["x1", "x4", "x8"].contains(&result["kernel"].as_str().expect("kernel")), "{result}");
        assert!(result["rays"].is_u64() && result["hits"].is_u64(), "{result}");
        assert!(result["sum_t"].as_f64().is_some_and(|t| t >= 0.0), "{result}");
        let (median, best) = (result["mrays_median"].as_f64().unwrap(), result["mrays_best"].as_f64().unwrap());
        assert!(0.0 < median && median <= best, "{result}");
        assert!(result["runs"].as_u64().is_some_and(|runs| (3..=31).contains(&runs)), "{result}");
        assert!(result["spread"].as_f64().is_some_and(|spread| spread >= 0.0), "{result}");
    }
}

fn queries(report: &Value) -> Vec<&str> {
    let mut queries: Vec<&str> =
        report["results"].as_array().unwrap().iter().map(|result| result["query"].as_str().unwrap()).collect();
    queries.dedup();
    queries
}

#[test]
fn bench_as_json() {
    let folder = folder();
    let run = raypacket(folder.path(), "bench good.toml --size 32x16 --threads 1 --json -").good();
    let report = parse(&run.stdout);
    check_bench(&report, "good", 1);
    for query in ["primary", "shadow", "reflection", "frame"] {
        assert!(queries(&report).contains(&query), "no {query}");
    }
    let primary = report["results"].as_array().unwrap().iter().find(|r| r["query"] == "primary").unwrap();
    assert_eq!(primary["rays"], 32 * 16);
}

#[test]
fn stages_of_a_picture_add_up() {
    let folder = folder();
    let text = raypacket(folder.path(), "bench good.toml --size 32x16 --stages").good().stdout;
    let mut lines = text.lines();
    assert!(lines.next().is_some_and(|line| line.starts_with("good  32×16  1 thread  x8")), "{text}");
    assert!(lines.next().is_some_and(|line| line.starts_with("stage")), "{text}");
    let rows: Vec<(f64, &str)> = lines
        .map(|line| {
            let number = line[18..].split_whitespace().next().expect("a number");
            (number.parse().expect("ns"), line)
        })
        .collect();
    let (all, stages) = rows.split_last().expect("rows");
    assert!(all.1.starts_with("all") && stages.len() == 7, "{text}");
    let sum: f64 = stages.iter().map(|row| row.0).sum();
    assert!(all.0 > 0.0 && (sum - all.0).abs() < 0.05, "{text}");
}

#[test]
fn methods_are_chosen_by_name_and_judged_like_all_others() {
    let folder = folder();
    let run = |line: &str| raypacket(folder.path(), line);
    let text = run("bench good.toml --size 32x16 --threads 1 --method sphere=double --json -").good().stdout;
    let methods = "sphere=double triangle=watertight torus=monotone_newton normalize=division offset=derived \
                   terminator=tangent_planes";
    assert_eq!(parse(&text)["methods"], methods);
    // The last of a kind counts; and info says that it was asked for.
    let text = run("info good.toml --method sphere=geometric --method sphere=quadratic").good().stdout;
    assert!(text.contains("method `quadratic`: as asked for"), "{text}");
    // Found out: the lecture's test sees no sphere from inside, no offset is no good anywhere, and flat triangles' shadows
    // are no good for round shading.
    for line in [
        "verify glass --size 64x32 --method sphere=geometric",
        "verify classic --size 64x32 --method offset=none",
        "verify vase --size 64x32 --method terminator=none",
    ] {
        let verdict = run(line);
        assert_eq!(verdict.status, Some(1), "{line}: {}", verdict.stdout);
        assert!(verdict.stdout.contains("FAIL"), "{line}: {}", verdict.stdout);
    }
    let line = "bench glass --size 32x16 --threads 1 --seconds 0 --method sphere=geometric";
    let verdict = run(line);
    assert_eq!(verdict.status, Some(1), "{line}: {}", verdict.stdout);
    assert!(verdict.stdout.contains("ANSWERS DISAGREE"), "{line}: {}", verdict.stdout);
    assert!(verdict.stderr.contains("do not agree with the reference: glass"), "{line}: {}", verdict.stderr);
    run("verify cosmos classic --size 64x32 --method sphere=double --method normalize=newton_2").good();
    let Run { status, stderr, .. } = run("render good.toml -o x.png --method sphere=cubic");
    assert_eq!(status, Some(2));
    assert!(stderr.contains("no method `cubic`; there are stable, quadratic, geometric, double"), "{stderr}");
    assert!(!folder.path().join("x.png").exists());
}

#[test]
fn bench_of_several_scenes_into_a_file() {
    let folder = folder();
    let args = "bench good.toml classic --size 32x16 --threads 2 --json a.json";
    let run = raypacket(folder.path(), args).good();
    assert!(run.stdout.contains("good") && run.stdout.contains("classic"), "{}", run.stdout);
    let reports = parse(&fs::read_to_string(folder.path().join("a.json")).unwrap());
    let reports = reports.as_array().expect("an array, as there are two");
    assert_eq!(reports.len(), 2);
    check_bench(&reports[0], "good", 2);
    check_bench(&reports[1], "classic", 2);
    assert_eq!(names(folder.path()), ["a.json", "good.toml"]);
}

#[test]
fn bench_as_a_page() {
    let folder = folder();
    let run = raypacket(folder.path(), "bench good.toml flake --size 32x16 --threads 1 --markdown a.md").good();
    assert!(run.stdout.contains("good"), "{}", run.stdout);
    let page = fs::read_to_string(folder.path().join("a.md")).unwrap();
    assert!(page.starts_with("# Rates on ") && page.contains(raypacket::math::isa()), "{page}");
    assert!(page.contains("\n## `good`, 32 × 16\n") && page.contains("\n## `flake`, 32 × 16\n"), "{page}");
    assert_eq!(
        page.matches("\n| query | rays | x1 | x4 | x8 |\n|---|---|---|---|---|\n| primary | 512 | ").count(),
        2,
        "{page}"
    );
    assert_eq!(page.matches("The tree was built in ").count(), 1, "{page}");

    let alone = raypacket(folder.path(), "bench good.toml --size 32x16 --threads 1 --markdown -").good().stdout;
    assert!(alone.starts_with("# Rates on ") && alone.ends_with("|\n"), "{alone}");
    let both = raypacket(folder.path(), "bench good.toml --json - --markdown -");
    both.failed(2, &["only one of --json and --markdown"]);
    assert_eq!(names(folder.path()), ["a.md", "good.toml"]);
}

#[test]
fn bench_of_a_ray_file() {
    let folder = folder();
    // One ray hits the sphere of `good.toml` at 4, one nothing, one is inactive.
    let rays: [[f32; 8]; 3] = [
        [0.0, 1.0, 5.0, 0.0, 0.0, 0.0, -1.0, 1e30],
        [0.0, 1.0, 5.0, 0.0, 0.0, 0.0, 1.0, 1e30],
        [0.0, 1.0, 5.0, 0.0, 0.0, 0.0, -1.0, -1.0],
    ];
    let bytes: Vec<u8> = rays.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    for (extension, sum) in [("primary", 4.0), ("shadow", 0.0)] {
        let file = format!("few.{extension}");
        fs::write(folder.path().join(&file), &bytes).unwrap();
        let args = format!("bench good.toml --size 32x16 --threads 1 --rays {file} --json -");
        let report = parse(&raypacket(folder.path(), &args).good().stdout);
        assert_eq!(queries(&report), [format!("rays:{extension}")]);
        for result in report["results"].as_array().unwrap() {
            assert_eq!((&result["rays"], &result["hits"]), (&2.into(), &1.into()), "{result}");
            assert!((result["sum_t"].as_f64().unwrap() - sum).abs() < 1e-4, "{result}");
        }
    }
}

#[test]
fn bench_tells_what_the_tree_took() {
    let folder = folder();
    add_many(folder.path());
    let ray: [f32; 8] = [0.0, 1.0, 5.0, 0.0, 0.0, 0.0, -1.0, 1e30];
    fs::write(folder.path().join("one.primary"), ray.map(f32::to_le_bytes).as_flattened()).unwrap();
    let args = "--size 32x16 --threads 1 --rays one.primary --json a.json";
    let bench = |scene: &str| {
        let text = raypacket(folder.path(), &format!("bench {scene} {args}")).good().stdout;
        (text, parse(&fs::read_to_string(folder.path().join("a.json")).unwrap()))
    };
    let (text, report) = bench("many.toml");
    check_bench(&report, "many", 1);
    let (ms, bytes) = (&report["build"]["ms"], &report["build"]["bytes"]);
    assert!(ms.as_f64().is_some_and(|ms| ms > 0.0), "{report}");
    assert!(bytes.as_u64().is_some_and(|bytes| bytes > 200 * 20), "{report}");
    let line = text.lines().find(|line| line.starts_with("tree: built in "));
    assert!(line.is_some_and(|line| line.ends_with(&format!(" ms, {bytes} bytes"))), "{text}");
    let (text, report) = bench("good.toml");
    assert!(report.get("build").is_none() && !text.contains("tree"), "there is none: {report} {text}");
}

#[test]
fn verify_as_json_and_as_text() {
    let folder = folder();
    let report = parse(&raypacket(folder.path(), "verify good.toml --size 32x16 --json -").good().stdout);
    assert_eq!((&report["scene"], &report["pass"]), (&"good".into(), &true.into()));
    let run = raypacket(folder.path(), "verify good.toml classic --size 32x16").good();
    assert!(run.stdout.contains("good") && run.stdout.contains("classic"), "{}", run.stdout);
}

#[test]
fn verify_takes_all_built_in_scenes() {
    let folder = folder();
    let run = raypacket(folder.path(), "verify --size 24x12 --json all.json").good();
    let reports = parse(&fs::read_to_string(folder.path().join("all.json")).unwrap());
    let scenes: Vec<&str> = reports.as_array().unwrap().iter().map(|r| r["scene"].as_str().unwrap()).collect();
    let builtins: Vec<&str> = raypacket::scene::builtins().iter().map(|b| b.name).collect();
    assert_eq!(scenes, builtins);
    assert!(builtins.iter().all(|name| run.stdout.contains(name)), "{}", run.stdout);
}
