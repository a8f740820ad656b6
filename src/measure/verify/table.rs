//! A report as text.
use super::Report;
use std::fmt;

const HEADER: &str = "scene    kernel     rays | hits differ unexplained | t err max t err p99.9 unexplained \
                      | pixels differ unexplained | same bits";

/// Several scenes under one header, then a line with each scene's verdict.
pub fn table(reports: &[Report]) -> String {
    let rows: String = reports.iter().map(rows).collect();
    let verdicts: String = reports.iter().map(verdict).collect();
    format!("{HEADER}\n{rows}{verdicts}").trim_end().to_owned()
}

impl fmt::Display for Report {
    /// The header, a row for each kernel, and `PASS` or `FAIL`; no newline at the end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&table(std::slice::from_ref(self)))
    }
}

fn rows(report: &Report) -> String {
    let same = if report.identical { "yes" } else { "NO" };
    let row = |kernel: &super::KernelReport| {
        let c = &kernel.comparison;
        format!(
            "{:<8} {:<6} {:>8} | {:>11} {:>11} | {:>9.1e} {:>11.1e} {:>11} | {:>13} {:>11} | {same:>9}\n",
            report.scene,
            kernel.kernel,
            c.rays,
            c.hits_different,
            c.hits_unexplained,
            c.t_error_max,
            c.t_error_p999,
            c.t_unexplained,
            c.pixels_different,
            c.pixels_unexplained,
        )
    };
    report.kernels.iter().map(row).collect()
}

fn verdict(report: &Report) -> String {
    format!("{} {}\n", if report.pass { "PASS" } else { "FAIL" }, report.scene)
}
