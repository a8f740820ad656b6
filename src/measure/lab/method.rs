//! The methods that a subject can be tested by.

use crate::geometry::methods::{Choice, SphereMethod, TorusMethod, TriangleMethod};
use crate::measure::cases::Subject;

/// A method by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    /// As it is called on the command line.
    pub name: &'static str,
    /// The choice to compile with; nothing where there is none.
    pub choice: Option<Choice>,
}

impl Method {
    /// The choices to compile a scene with.
    pub fn choices(&self) -> &[Choice] {
        self.choice.as_slice()
    }
}

/// All methods for a subject, the default first; the only one of a subject that has no choice is called `default`.
pub fn methods(subject: Subject) -> Vec<Method> {
    let of = |name, choice| Method { name, choice: Some(choice) };
    match subject {
        Subject::Sphere => SphereMethod::ALL.iter().map(|&m| of(m.name(), Choice::Sphere(m))).collect(),
        Subject::Triangle => TriangleMethod::ALL.iter().map(|&m| of(m.name(), Choice::Triangle(m))).collect(),
        Subject::Torus => TorusMethod::ALL.iter().map(|&m| of(m.name(), Choice::Torus(m))).collect(),
        _ => vec![Method { name: "default", choice: None }],
    }
}
