//! The file of `bench --against`: what `bench --json` wrote earlier.

use super::failure::Failure;
use raypacket::files;
use raypacket::measure::against::{Row, Run};
use serde_json::Value;
use std::io::Read;
use std::path::Path;

/// The longest file that is read, in bytes; a row takes some 200.
const LONGEST: u64 = 16 << 20;

/// Reads the file; a message names it and the key.
pub fn read(path: &Path) -> Result<Vec<Run>, Failure> {
    let fault = |problem: String| Failure::input(format!("{}: {problem}", path.display()));
    let (file, meta) = files::open(path).map_err(|e| fault(e.to_string()))?;
    if meta.len() > LONGEST {
        return Err(fault(format!("{} bytes are more than {LONGEST}", meta.len())));
    }
    let mut text = String::new();
    // The file may grow.
    file.take(LONGEST).read_to_string(&mut text).map_err(|e| fault(e.to_string()))?;
    runs(&text).map_err(fault)
}

/// The runs in the text: an object is one, an array has one or more.
fn runs(text: &str) -> Result<Vec<Run>, String> {
    let value: Value = serde_json::from_str(text).map_err(|e| format!("no JSON of `bench --json`: {e}"))?;
    let Value::Array(reports) = &value else {
        return Ok(vec![run(&Place { value: &value, name: String::new() })?]);
    };
    if reports.is_empty() {
        return Err("no JSON of `bench --json`: an empty array".into());
    }
    reports.iter().enumerate().map(|(i, value)| run(&Place { value, name: format!("[{i}]") })).collect()
}

fn run(report: &Place) -> Result<Run, String> {
    let size = report.get("size")?.items()?;
    let size: Vec<String> = size.iter().map(|side| side.count().map(|n| n.to_string())).collect::<Result<_, _>>()?;
    let setting = vec![
        ("CPU", report.get("cpu")?.text()?),
        ("instruction set", report.get("isa")?.text()?),
        ("threads", report.get("threads")?.count()?.to_string()),
        ("size", size.join("x")),
        ("methods", report.get("methods")?.text()?),
    ];
    let rows = report.get("results")?.items()?;
    Ok(Run {
        scene: report.get("scene")?.text()?,
        setting,
        built: [report.get("commit")?.text()?, report.get("date")?.text()?],
        rows: rows.iter().map(row).collect::<Result<_, _>>()?,
    })
}

fn row(row: &Place) -> Result<Row, String> {
    Ok(Row {
        query: row.get("query")?.text()?,
        kernel: row.get("kernel")?.text()?,
        rays: row.get("rays")?.count()?,
        mrays: row.get("mrays_median")?.number()?,
        spread: row.get("spread")?.number()?,
    })
}

/// A value, and the keys that lead to it.
struct Place<'a> {
    value: &'a Value,
    name: String,
}

impl<'a> Place<'a> {
    fn get(&self, key: &str) -> Result<Place<'a>, String> {
        let name = if self.name.is_empty() { key.to_owned() } else { format!("{}.{key}", self.name) };
        let value = self.value.get(key).ok_or_else(|| format!("{name}: is missing"))?;
        Ok(Place { value, name })
    }

    fn fault(&self, what: &str) -> String {
        format!("{}: must be {what}", self.name)
    }

    /// Control characters, which could move a terminal's cursor, become `?`.
    fn text(&self) -> Result<String, String> {
        let text = self.value.as_str().ok_or_else(|| self.fault("a text"))?;
        Ok(text.replace(char::is_control, "?"))
    }

    fn count(&self) -> Result<u64, String> {
        self.value.as_u64().ok_or_else(|| self.fault("a whole number from 0 on"))
    }

    fn number(&self) -> Result<f64, String> {
        // Far beyond any rate, and far from where products overflow.
        let number = self.value.as_f64().filter(|n| (0.0..=1e12).contains(n));
        number.ok_or_else(|| self.fault("a number from 0 on"))
    }

    fn items(&self) -> Result<Vec<Place<'a>>, String> {
        let items = self.value.as_array().ok_or_else(|| self.fault("an array"))?;
        Ok(items.iter().enumerate().map(|(i, value)| Place { value, name: format!("{}[{i}]", self.name) }).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"{"scene":"s","size":[4,2],"threads":1,"isa":"i","cpu":"c","version":"v","commit":"x","date":"d",
        "methods":"m","valid":true,"results":[{"query":"primary","kernel":"x8","rays":8,"hits":4,"sum_t":1.0,
        "mrays_median":2.0,"mrays_best":3.0,"runs":3,"spread":0.5}]}"#;

    #[test]
    fn objects_and_arrays() {
        let found = runs(GOOD).unwrap();
        let [run] = &found[..] else { panic!("one run") };
        assert_eq!(run.scene, "s");
        assert_eq!(run.setting[3], ("size", "4x2".into()));
        let row = Row { query: "primary".into(), kernel: "x8".into(), rays: 8, mrays: 2.0, spread: 0.5 };
        assert_eq!(run.rows, [row]);
        assert_eq!(runs(&format!("[{GOOD},{GOOD}]")).unwrap(), [run.clone(), run.clone()]);
    }

    #[test]
    fn faults_name_the_key() {
        for (from, to, fault) in [
            ("\"rays\":8", "\"rays\":-8", "results[0].rays: must be a whole number from 0 on"),
            ("\"rays\":8,", "", "results[0].rays: is missing"),
            ("2.0", "\"2.0\"", "results[0].mrays_median: must be a number from 0 on"),
            ("2.0", "-2.0", "results[0].mrays_median: must be a number from 0 on"),
            ("\"spread\":0.5", "\"spread\":1e300", "results[0].spread: must be a number from 0 on"),
            ("\"cpu\":\"c\",", "", "cpu: is missing"),
            ("[4,2]", "7", "size: must be an array"),
            ("\"s\"", "null", "scene: must be a text"),
        ] {
            assert_eq!(GOOD.matches(from).count(), 1, "{from}");
            assert_eq!(runs(&GOOD.replace(from, to)).unwrap_err(), fault);
        }
        assert_eq!(runs("7").unwrap_err(), "size: is missing");
        assert_eq!(runs("[{}]").unwrap_err(), "[0].size: is missing");
        for text in ["", "{", "[]", "{} {}", &"[".repeat(10_000)] {
            assert!(runs(text).unwrap_err().starts_with("no JSON of `bench --json`: "), "{text:.9}");
        }
    }
}
