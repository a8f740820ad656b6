//! Every chart from very little measuring: both files are sound, and say what was measured.

use std::sync::atomic::{AtomicU32, Ordering};

use super::*;

const TINY: Budget = Budget {
    rays: 16,
    settings: 3,
    batches: 2,
    turns: 1,
    spawned: 400,
    frame: [24, 12],
    frame_turns: 1,
    converged: 4,
    heat: [24, 16],
};

/// Asserts that every tag is closed in its order, attributes are quoted, and nothing is left over. Gives all text.
fn well_formed(svg: &str) -> String {
    let (mut open, mut text) = (Vec::new(), String::new());
    let mut parts = svg.trim_end().split('<');
    assert_eq!(parts.next(), Some(""), "starts with a tag");
    for part in parts {
        let (tag, after) = part.split_once('>').expect("a tag ends");
        assert!(!after.contains('>'), "{after}");
        // An ampersand starts one of the five that XML knows.
        for entity in after.split('&').skip(1) {
            let name = entity.split(';').next().unwrap();
            assert!(["amp", "lt", "gt", "quot", "apos"].contains(&name) || name.starts_with('#'), "{after}");
        }
        text += after;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "{tag}");
            continue;
        }
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().unwrap().to_owned());
        }
    }
    assert!(open.is_empty(), "{open:?}");
    text
}

/// The rows of CSV without quoted line breaks.
fn parse(csv: &str) -> Vec<Vec<String>> {
    let row = |line: &str| {
        let (mut cells, mut quoted) = (vec![String::new()], false);
        for c in line.chars() {
            match c {
                '"' => quoted = !quoted,
                ',' if !quoted => cells.push(String::new()),
                c => cells.last_mut().unwrap().push(c),
            }
        }
        assert!(!quoted, "{line}");
        cells
    };
    csv.lines().map(row).collect()
}

fn drawn(name: &str) -> (String, Vec<Vec<String>>) {
    let machine = Machine { cpu: "A <fast> & \"small\", CPU".into(), ..Machine::this() };
    let most = AtomicU32::new(0);
    let progress = |share: f32| {
        assert!((0.0..=1.0).contains(&share), "{share}");
        most.fetch_max((share * 100.0) as u32, Ordering::Relaxed);
    };
    let chart = draw(name, &TINY, &machine, &progress).unwrap();
    assert!(chart.sound, "{name}: widths differ");
    assert_eq!((&*chart.name, most.load(Ordering::Relaxed)), (name, 100));
    let text = well_formed(&chart.svg);
    for words in ["A &lt;fast&gt; &amp; &quot;small&quot;, CPU", machine.isa, machine.commit] {
        assert!(text.contains(words), "no {words:?} in {name}");
    }
    assert!(!chart.svg.contains("NaN") && !chart.svg.contains("inf"), "{name}");
    let rows = parse(&chart.table.to_csv(&machine));
    assert!(rows.len() > 1 && rows.iter().all(|row| row.len() == rows[0].len()), "{name}");
    assert!(rows.iter().skip(1).all(|row| row[row.len() - 4] == "A <fast> & small, CPU"), "{name}");
    (text, rows)
}

/// The numbers in a column.
fn column(rows: &[Vec<String>], name: &str) -> Vec<f64> {
    let at = rows[0].iter().position(|h| h == name).unwrap_or_else(|| panic!("no {name} in {:?}", rows[0]));
    rows.iter().skip(1).map(|row| row[at].parse().unwrap_or_else(|_| panic!("{}: {}", name, row[at]))).collect()
}

#[test]
fn speed_and_error_of_every_method_and_width() {
    let (text, rows) = drawn("speed-error");
    let methods = 3
        * (crate::geometry::methods::SphereMethod::ALL.len()
            + crate::geometry::methods::TriangleMethod::ALL.len()
            + crate::geometry::methods::TorusMethod::ALL.len());
    assert_eq!(rows.len(), 1 + methods);
    for words in ["quadratic", "moller_trumbore", "monotone_newton", "Pareto", "ns per ray"] {
        assert!(text.contains(words), "no {words:?}");
    }
    let [low, median, high] = ["ns_low", "ns_per_ray", "ns_high"].map(|name| column(&rows, name));
    assert!((0..methods).all(|i| 0.0 < low[i] && low[i] <= median[i] && median[i] <= high[i]));
    assert!(column(&rows, "hits").iter().all(|&hits| hits > 20.0));
    // The frontier has the fastest of each, and not all.
    let marked = rows.iter().skip(1).filter(|row| row.contains(&"true".to_owned())).count();
    assert!((3..methods).contains(&marked), "{marked}");
}

#[test]
fn failures_along_every_dial() {
    for name in ["failure-sphere", "failure-triangle", "failure-torus", "failure-others"] {
        let (_, rows) = drawn(name);
        assert!(column(&rows, "rays").iter().all(|&rays| rays == TINY.rays as f64), "{name}");
        assert!(column(&rows, "hits").iter().sum::<f64>() > 0.0, "{name}");
    }
    let (_, rows) = drawn("failure-sphere");
    let of = |method: &str, setting: f64| {
        let row = rows.iter().find(|r| r[0] == "sphere-far" && r[4] == method && r[3].parse() == Ok(setting)).unwrap();
        row[12].parse::<f64>().unwrap()
    };
    // Where the textbook's has lost all digits, the default has most.
    assert!(of("quadratic", 1e7) == 0.0 || of("quadratic", 1e7) > 1.0);
    assert!(of("stable", 1.0) < 64.0, "{}", of("stable", 1.0));
}

#[test]
fn no_fixed_epsilon_is_right_everywhere_but_the_derived_offset_is() {
    let (_, rows) = drawn("epsilon");
    let [acne, leaks] = ["acne_per_million", "leaks_per_million"].map(|name| column(&rows, name));
    let wrong = |offset: &str, epsilon: &str| -> f64 {
        let rows = rows.iter().skip(1).enumerate().filter(|(_, row)| row[0] == offset && row[1] == epsilon);
        rows.map(|(i, _)| acne[i] + leaks[i]).sum()
    };
    assert_eq!(wrong("derived", ""), 0.0);
    assert!(wrong("none", "") > 0.0);
    for epsilon in ["0.01", "0.001", "0.0001", "0.00001", "0.000001", "0.0000001"] {
        assert!(wrong("fixed", epsilon) > 1e5, "{epsilon}");
    }
}

#[test]
fn frames_of_built_in_scenes() {
    let (text, rows) = drawn("frames");
    assert!(crate::measure::lab::SCENES.iter().all(|scene| text.contains(scene)));
    assert!(column(&rows, "ms_per_frame").iter().all(|&ms| ms > 0.0));
    let (off, rms) = (column(&rows, "pixels_off_percent"), column(&rows, "rms_255"));
    assert!(off.iter().all(|off| (0.0..=100.0).contains(off)) && rms.iter().all(|rms| (0.0..=255.0).contains(rms)));
    let adaptive = |row: &&Vec<String>| row[3] == "adaptive:5";
    assert_eq!(rows.iter().filter(adaptive).count(), crate::measure::lab::SCENES.len());
    assert!(rows.iter().filter(adaptive).all(|row| (4.0..=16.0).contains(&row[4].parse::<f64>().unwrap())));
    // By the plan, what is apart from the plan is nothing.
    let apart = column(&rows, "rms_from_planned_255");
    assert!(rows.iter().skip(1).zip(&apart).all(|(row, &apart)| row[1] != "planned" || apart == 0.0));
    assert!(apart.iter().any(|&apart| apart > 0.0));
}

#[test]
fn heat_maps_of_the_textbook_failures() {
    for name in names().iter().filter(|name| name.starts_with("heat-")) {
        let (text, rows) = drawn(name);
        assert_eq!(rows.len(), 1 + TINY.heat[0] * TINY.heat[1], "{name}");
        assert!(text.contains("(the default)"), "{name}");
        let hits = |column: usize| rows.iter().skip(1).filter(|row| row[column].parse::<f64>().is_ok()).count();
        assert!(hits(rows[0].len() - 5) > 100, "{name}: the default hits");
    }
    assert!(draw("heat-x", &TINY, &Machine::this(), &|_| ()).unwrap_err().contains("heat-acne"));
}

#[test]
fn rates_and_ratios_of_runs() {
    use crate::measure::against::{Comparison, Run};
    use crate::measure::bench;
    let description = crate::scene::load("classic").unwrap();
    let scene = crate::scene::compile(&description).unwrap();
    let options = bench::Options { size: [16, 8], rays: None, budget: std::time::Duration::ZERO };
    let mut report = bench::run(&description, &scene, &options).unwrap();
    report.scene = "<s>\u{7}".into();
    report.results[0].spread = 0.5;
    report.results[1].spread = 0.01;
    let machine = Machine { cpu: "A & B".into(), ..Machine::this() };
    let text = rates(&[report.clone(), report.clone()], &machine);
    assert!(!text.contains("NaN") && !text.contains("inf") && !text.contains('\u{7}'));
    let words = well_formed(&text);
    for part in ["&lt;s&gt;?, 16 × 8", "primary", "reflection", "frame", "x4", " noisy", "A &amp; B"] {
        assert!(words.contains(part), "no {part:?} in {words}");
    }
    let mut faster = report.clone();
    faster.results.iter_mut().for_each(|row| row.mrays_median *= 4.0);
    let comparison = Comparison::new(&[Run::from(&report)], &[Run::from(&faster)]);
    let text = ratios(&comparison, &machine);
    assert!(!text.contains("NaN") && !text.contains("inf"));
    let words = well_formed(&text);
    for part in ["&lt;s&gt;?  primary  x1", "4.000  faster", "A &amp; B"] {
        assert!(words.contains(part), "no {part:?} in {words}");
    }
    let nothing = Comparison::new(&[], &[]);
    well_formed(&ratios(&nothing, &machine));
    well_formed(&rates(&[], &machine));
}
