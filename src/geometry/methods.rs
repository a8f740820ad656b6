//! The named methods that a scene can be traced by. Each kind of work has one that is the default; the others are there
//! to be compared with it.

use std::fmt;
use std::str::FromStr;

/// An enum of methods with their names; the first is the default.
macro_rules! methods {
    ($(#[$doc:meta])* $kind:ident { $($(#[$what:meta])* $method:ident = $name:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $kind {
            $($(#[$what])* $method,)*
        }

        impl $kind {
            /// All of them, the default first.
            pub const ALL: &[Self] = &[$(Self::$method),*];

            /// As it is called.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$method => $name,)*
                }
            }

            fn find(name: &str) -> Result<Self, String> {
                Self::ALL.iter().copied().find(|m| m.name() == name).ok_or_else(|| {
                    let names: Vec<_> = Self::ALL.iter().map(|m| m.name()).collect();
                    format!("no method `{name}`; there are {}", names.join(", "))
                })
            }
        }

        impl Default for $kind {
            fn default() -> Self {
                Self::ALL[0]
            }
        }
    };
}

methods! {
    /// How a sphere is tested ([`super::sphere`]).
    SphereMethod {
        /// The distance of the ray from the centre first, and the root that does not cancel.
        Stable = "stable",
        /// −b ± √(b² − c).
        Quadratic = "quadratic",
        /// The lecture's efficient one, from outside only.
        Geometric = "geometric",
        /// [`SphereMethod::Quadratic`] in `f64`.
        Double = "double",
    }
}

methods! {
    /// How a triangle is tested ([`super::triangle`]).
    TriangleMethod {
        /// Woop's, Benthin's and Wald's.
        Watertight = "watertight",
        /// Möller's and Trumbore's.
        MollerTrumbore = "moller_trumbore",
        /// By the planes through the origin and the edges.
        EdgePlanes = "edge_planes",
    }
}

methods! {
    /// How a torus is tested ([`super::torus`]).
    TorusMethod {
        /// Newton's on stretches without an inflection.
        MonotoneNewton = "monotone_newton",
        /// Ferrari's closed form of the quartic's roots.
        Ferrari = "ferrari",
        /// Steps as long as the distance to the surface.
        SphereTrace = "sphere_trace",
    }
}

methods! {
    /// How spheres' normals and shadow rays' directions are brought to unit length ([`crate::math::Vec3::normalize_by`]).
    NormalizeMethod {
        /// One square root, one division.
        Division = "division",
        /// The hardware's estimate of 1/√.
        Estimate = "estimate",
        /// After one of Newton's steps.
        Newton1 = "newton_1",
        /// After two.
        Newton2 = "newton_2",
    }
}

methods! {
    /// How far off a surface rays start ([`crate::shade`]).
    OffsetMethod {
        /// A bound on what rounding can do.
        Derived = "derived",
        /// Not at all.
        None = "none",
        /// By 10⁻⁴ world units.
        Fixed = "fixed",
        /// By 10⁻⁴ of the point's largest coordinate.
        Scaled = "scaled",
    }
}

methods! {
    /// Where shadow rays start that leave triangles with vertex normals ([`crate::shade`]).
    TerminatorMethod {
        /// On the surface that the vertices' tangent planes make.
        TangentPlanes = "tangent_planes",
        /// On the triangle.
        None = "none",
    }
}

impl NormalizeMethod {
    /// Newton's steps after the estimate; `None` for a root and a division.
    pub fn steps(self) -> Option<u32> {
        match self {
            Self::Division => None,
            Self::Estimate => Some(0),
            Self::Newton1 => Some(1),
            Self::Newton2 => Some(2),
        }
    }
}

/// The methods by which a scene is traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Methods {
    /// Spheres.
    pub sphere: SphereMethod,
    /// Triangles.
    pub triangle: TriangleMethod,
    /// Tori.
    pub torus: TorusMethod,
    /// Vectors of unit length.
    pub normalize: NormalizeMethod,
    /// Where secondary rays start.
    pub offset: OffsetMethod,
    /// Shadow rays from interpolated normals.
    pub terminator: TerminatorMethod,
}

/// One choice, such as `sphere=geometric`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// Of a sphere's method.
    Sphere(SphereMethod),
    /// Of a triangle's.
    Triangle(TriangleMethod),
    /// Of a torus's.
    Torus(TorusMethod),
    /// Of the way to unit length.
    Normalize(NormalizeMethod),
    /// Of the offset.
    Offset(OffsetMethod),
    /// Of the shadow rays from interpolated normals.
    Terminator(TerminatorMethod),
}

impl FromStr for Choice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((kind, name)) = text.split_once('=') else {
            return Err("expected KIND=METHOD, such as sphere=geometric".into());
        };
        let choice = match kind {
            "sphere" => SphereMethod::find(name).map(Self::Sphere),
            "triangle" => TriangleMethod::find(name).map(Self::Triangle),
            "torus" => TorusMethod::find(name).map(Self::Torus),
            "normalize" => NormalizeMethod::find(name).map(Self::Normalize),
            "offset" => OffsetMethod::find(name).map(Self::Offset),
            "terminator" => TerminatorMethod::find(name).map(Self::Terminator),
            _ => {
                return Err(format!(
                    "no kind `{kind}`; there are sphere, triangle, torus, normalize, offset, terminator"
                ));
            }
        };
        choice.map_err(|message| format!("{kind}: {message}"))
    }
}

impl Methods {
    /// With one choice made.
    pub fn with(mut self, choice: Choice) -> Self {
        match choice {
            Choice::Sphere(method) => self.sphere = method,
            Choice::Triangle(method) => self.triangle = method,
            Choice::Torus(method) => self.torus = method,
            Choice::Normalize(method) => self.normalize = method,
            Choice::Offset(method) => self.offset = method,
            Choice::Terminator(method) => self.terminator = method,
        }
        self
    }

    /// As choices.
    pub fn choices(self) -> [Choice; 6] {
        let Self { sphere, triangle, torus, normalize, offset, terminator } = self;
        [
            Choice::Sphere(sphere),
            Choice::Triangle(triangle),
            Choice::Torus(torus),
            Choice::Normalize(normalize),
            Choice::Offset(offset),
            Choice::Terminator(terminator),
        ]
    }
}

impl fmt::Display for Methods {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { sphere, triangle, torus, normalize, offset, terminator } = self;
        write!(f, "sphere={} triangle={} torus={} ", sphere.name(), triangle.name(), torus.name())?;
        write!(f, "normalize={} offset={} terminator={}", normalize.name(), offset.name(), terminator.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_read_by_name() {
        let chosen = ["sphere=geometric", "torus=monotone_newton", "offset=none", "sphere=double"]
            .into_iter()
            .fold(Methods::default(), |methods, text| methods.with(text.parse().unwrap()));
        assert_eq!(
            chosen.to_string(),
            "sphere=double triangle=watertight torus=monotone_newton normalize=division offset=none \
             terminator=tangent_planes"
        );
        let error = |text: &str| text.parse::<Choice>().unwrap_err();
        assert_eq!(error("sphere"), "expected KIND=METHOD, such as sphere=geometric");
        assert_eq!(error("cube=x"), "no kind `cube`; there are sphere, triangle, torus, normalize, offset, terminator");
        assert_eq!(error("sphere=cubic"), "sphere: no method `cubic`; there are stable, quadratic, geometric, double");
    }
}
