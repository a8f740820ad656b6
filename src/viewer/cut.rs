//! The outlines that a horizontal plane cuts out of a scene's primitives, in (x, z), in `f64` from the description.

use super::outline::Outline;
use super::section::{Cut, Section};
use crate::kinds::for_each_kind;
use crate::scene::Description;

/// Hands on everything that a horizontal plane cuts, as far as it is seen.
pub fn cuts(description: &Description, section: &Section, mut emit: impl FnMut(Cut)) {
    // Whatever the description holds, nothing but numbers gets through.
    let emit = &mut |cut: Cut| {
        if cut.is_finite() {
            emit(cut);
        }
    };
    macro_rules! all {
        ($($bounds:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
            $($(description.$field.iter().for_each(|it| it.cuts(section, emit));)*)*
        };
    }
    for_each_kind!(all);
}

#[cfg(test)]
#[path = "cut_tests.rs"]
mod tests;
