//! The plan in words: what the tracer does for a scene, and why.

use raypacket::geometry::methods::{Methods, NormalizeMethod, OffsetMethod};
use raypacket::scene::{Plan, ShadowStart, Structure, Tested};
use std::fmt::{self, Display, Formatter};

/// A plan, a line for each of its decisions.
pub struct PlanText<'a>(pub &'a Plan);

impl Display for PlanText<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(plan) = self;
        for tested in plan.tested().iter().filter(|tested| tested.count > 0) {
            writeln!(f, "{:<11} {}: {}", tested.kind.many, tested.count, method(tested))?;
        }
        structure(plan, f)?;
        waves(plan, f)?;
        if plan.smooth {
            let from = if plan.raised { "the tangent planes of vertices" } else { "the triangles, as asked for" };
            writeln!(f, "normals     interpolated where a mesh has them; shadow rays start on {from}")?;
        }
        shadows(plan, f)?;
        others(&plan.methods, f)?;
        if plan.shadows.is_empty() {
            writeln!(f, "shadows     none: there is no light")?;
        }
        let highlights = if plan.highlights { "yes: a material is specular" } else { "no: no material is specular" };
        write!(f, "highlights  {highlights}")
    }
}

/// How a kind is tested, and why.
fn method(tested: &Tested<'_>) -> String {
    match (tested.method, tested.reason) {
        (None, None) => tested.kind.method.to_owned(),
        (None, Some(reason)) => format!("{}: {reason}", tested.kind.method),
        (Some(name), None) => format!("method `{name}`, as asked for"),
        (Some(name), Some(reason)) => format!("method `{name}`: {reason}"),
    }
}

fn structure(plan: &Plan, f: &mut Formatter<'_>) -> fmt::Result {
    let (spheres, others) = (Plan::TREE_FROM, Plan::TREE_FROM / 4);
    match plan.structure {
        Structure::None => writeln!(
            f,
            "structure   none: every batch of rays tests all that its bounds do not rule out; a tree pays from \
             {spheres} spheres or {others} others on",
        ),
        Structure::Tree => writeln!(
            f,
            "structure   tree, as {spheres} spheres or {others} others pay for one: groups of rays that run together \
             descend behind a beam around them, others in packets of sixteen",
        ),
    }
}

fn waves(plan: &Plan, f: &mut Formatter<'_>) -> fmt::Result {
    let &Plan { waves, materials, mirrors, glasses, .. } = plan;
    match (mirrors, glasses) {
        (0, 0) => writeln!(f, "waves       1: nothing reflects"),
        (n, 0) => writeln!(f, "waves       {waves}: {n} of {materials} materials reflect; max_depth"),
        (n, k) => {
            writeln!(f, "waves       {waves}: of {materials} materials {n} reflect and {k} transmit; max_depth")?;
            let by = if plan.absorbs { "absorption by channel" } else { "none absorbs" };
            writeln!(f, "bodies      a ray keeps those it is in; {by}; what counts for less than 2^-14 is dropped")
        }
    }
}

fn shadows(plan: &Plan, f: &mut Formatter<'_>) -> fmt::Result {
    let from_light = plan.shadows.iter().filter(|s| **s == ShadowStart::Light).count();
    let from_point = plan.shadows.len() - from_light;
    let streams = |n: usize| if n == 1 { "1 stream".to_owned() } else { format!("{n} streams") };
    if from_light > 0 {
        let streams = streams(from_light);
        writeln!(f, "shadows     {streams} a wave from lights, so that their rays share an origin")?;
    }
    if from_point > 0 {
        let (streams, farthest) = (streams(from_point), Plan::FARTHEST);
        writeln!(
            f,
            "shadows     {streams} a wave towards lights over {farthest} sizes from a primitive, or from what is seen: \
             too far to aim at it from there"
        )?;
    }
    Ok(())
}

/// The methods that no primitive is tested by.
fn others(methods: &Methods, f: &mut Formatter<'_>) -> fmt::Result {
    let &Methods { normalize, offset, .. } = methods;
    if normalize != NormalizeMethod::default() {
        writeln!(f, "unit        method `{}`, as asked for", normalize.name())?;
    }
    if offset != OffsetMethod::default() {
        writeln!(f, "offset      method `{}`, as asked for", offset.name())?;
    }
    Ok(())
}
