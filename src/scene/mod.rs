//! From what the user wrote ([`Description`]) to what is traced ([`Scene`]).
mod description;
pub use description::*;

/// A compiled scene: SoA arrays, ready to trace.
#[derive(Debug)]
pub struct Scene {
    /// Plan.
    pub plan: Plan,
}

/// Why a description cannot be rendered: the key at fault and what is wrong with it.
#[derive(Debug, thiserror::Error, PartialEq)]
#[error("{key}: {problem}")]
pub struct Invalid {
    /// The key, as the TOML file spells its place: `sphere[3].radius`.
    pub key: String,
    /// What is wrong, with the value.
    pub problem: String,
}

/// Compiles a description into SoA arrays.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile(description: &Description) -> Result<Scene, Invalid> {
    check(description)?;
    Ok(Scene { plan: Plan })
}

/// Says what is wrong with a description, if anything is.
///
/// # Errors
/// The first fault.
pub fn check(_description: &Description) -> Result<(), Invalid> {
    Ok(())
}

/// STUB.
#[derive(Debug)]
pub struct Plan;
impl std::fmt::Display for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("spheres: brute force\nmirrors: none")
    }
}

/// STUB.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ReadError(String);

/// STUB.
pub struct Builtin {
    /// STUB.
    pub name: &'static str,
    /// STUB.
    pub summary: &'static str,
    /// STUB.
    pub source: &'static str,
}

/// STUB.
pub fn builtins() -> &'static [Builtin] {
    &[
        Builtin { name: "classic", summary: "stub of classic", source: "" },
        Builtin { name: "flake", summary: "stub of flake", source: "" },
    ]
}

/// STUB.
///
/// # Errors
/// STUB.
pub fn load(name: &str) -> Result<Description, ReadError> {
    if !builtins().iter().any(|b| b.name == name) {
        std::fs::read_to_string(name).map_err(|e| ReadError(format!("{name}: {e}")))?;
    }
    Ok(Description { name: name.into(), ..Default::default() })
}
