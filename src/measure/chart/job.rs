//! The context that a chart is made in, and the result.

use super::table::Table;
use crate::measure::lab::{Budget, Machine};

/// A chart and its data.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Of both files, without an extension.
    pub name: String,
    /// The drawing.
    pub svg: String,
    /// The data.
    pub table: Table,
    /// Whether answers that have to agree did, in the run that was measured.
    pub sound: bool,
}

/// The context that charts are made in.
pub struct Context<'a> {
    /// How much to measure.
    pub budget: &'a Budget,
    /// Where.
    pub machine: &'a Machine,
    /// Called with the share done.
    pub progress: &'a (dyn Fn(f32) + Sync),
}
