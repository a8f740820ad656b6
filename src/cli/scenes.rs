//! `raypacket scenes`: the built-in scenes.

use super::failure::Failure;
use super::print;
use raypacket::scene;

pub fn run() -> Result<(), Failure> {
    let all = scene::builtins();
    let width = all.iter().map(|b| b.name.len()).max().unwrap_or(0);
    let lines: Vec<String> = all.iter().map(|b| format!("{:width$}  {}", b.name, b.summary)).collect();
    print::line(lines.join("\n"))
}
