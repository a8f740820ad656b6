//! The widths, by name.

/// Which width the tracer runs at. Every width gives the same bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Kernel {
    /// One ray at a time.
    X1,
    /// Four lanes.
    X4,
    /// Eight lanes; sixteen in a build for AVX-512.
    #[default]
    X8,
}

impl Kernel {
    /// All of them, narrowest first.
    pub const ALL: [Kernel; 3] = [Kernel::X1, Kernel::X4, Kernel::X8];

    /// `x1`, `x4`, `x8`.
    pub fn name(self) -> &'static str {
        match self {
            Kernel::X1 => "x1",
            Kernel::X4 => "x4",
            Kernel::X8 => "x8",
        }
    }
}

/// Calls a function that is generic over [`crate::math::Lanes`] at a kernel's width: `with_lanes!(kernel, f(a, b))`.
macro_rules! with_lanes {
    ($kernel:expr, $function:ident($($argument:expr),* $(,)?)) => {
        match $kernel {
            $crate::render::Kernel::X1 => $function::<f32>($($argument),*),
            $crate::render::Kernel::X4 => $function::<wide::f32x4>($($argument),*),
            $crate::render::Kernel::X8 => $function::<<wide::f32x8 as $crate::math::Lanes>::Wider>($($argument),*),
        }
    };
}
pub(crate) use with_lanes;
