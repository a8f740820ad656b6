//! Prints the built-in scene `lattice`: `cargo run --example lattice > scenes/lattice.toml`.
mod crystal;

fn main() {
    print!("{}", crystal::toml());
}
