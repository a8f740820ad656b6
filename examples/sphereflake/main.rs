//! Prints the built-in scene `flake`: `cargo run --example sphereflake > scenes/flake.toml`.
mod flake;

fn main() {
    print!("{}", flake::toml());
}
