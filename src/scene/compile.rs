//! From a [`Description`] to the arrays that are traced.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec3;

use super::in_tree::InTree;
use super::kinds::Kind;
use super::media::{Medium, media};
use super::plan::Structure;
use super::poles;
use super::{Description, Invalid, Light, Material, Mesh, Plan, Settings, Sky, Texture, check};
use crate::bvh::{Aabb, Bvh};
use crate::geometry::methods::Choice;
use crate::geometry::{self, Primitives};
use crate::kinds::for_each_kind;

/// A caller's choices for a compiled scene, in place of the plan's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompileOptions {
    /// The structure. Then spheres are tested by the stable method, unless another is asked for, so that every structure
    /// gives the same bits.
    pub structure: Option<Structure>,
    /// Methods, of which the last of a kind counts.
    pub methods: Vec<Choice>,
}

impl From<Structure> for CompileOptions {
    /// The structure, and the plan's methods.
    fn from(structure: Structure) -> Self {
        Self { structure: Some(structure), methods: Vec::new() }
    }
}

impl From<&[Choice]> for CompileOptions {
    /// These methods, and the plan's for all else.
    fn from(methods: &[Choice]) -> Self {
        Self { structure: None, methods: methods.to_vec() }
    }
}

/// The scene and the ids of its primitives, with a field for each kind.
macro_rules! scene {
    ($($group:ident { $(($storage:ident: $Storage:ident, $field:ident: $Kind:ident, $module:ident))* })*) => {
        /// A compiled scene: SoA arrays, ready to trace.
        ///
        /// Primitive ids run through the kinds in the order of the fields, from planes to discs.
        #[derive(Clone, Debug)]
        pub struct Scene {
            $($(
                #[doc = concat!("The arrays of the kind [`", stringify!($module), "`](geometry::", stringify!($module), ").")]
                pub $storage: geometry::$Storage,
            )*)*
            /// The first id of every kind.
            pub first: First,
            /// The first triangle of every mesh, counted through all meshes.
            pub mesh_first: Vec<u32>,
            /// Boxes around all from the quads on, in the order of their ids.
            pub boxes: Vec<Aabb>,
            /// The tree of all but the planes, where the plan asks for one.
            pub bvh: Option<Bvh>,
            /// How long it took to build that tree; 0 without one.
            pub build_time: Duration,
            /// Materials, by index.
            pub materials: Vec<Material>,
            /// Transparent media by number; 0 is what is around them all.
            pub media: Vec<Medium>,
            /// The number of the medium that a material makes, by its index; 0 for one that is not transparent.
            pub medium_of: Vec<u16>,
            /// Texture images, by index.
            pub textures: Vec<Arc<Texture>>,
            /// A texture's colours where v is 0 and 1 and these are single points, by material.
            pub poles: Vec<[Vec3; 2]>,
            /// Point lights.
            pub lights: Vec<Light>,
            /// The radiance along rays that hit nothing.
            pub sky: Sky,
            /// Depth, light fall-off, ambient light.
            pub settings: Settings,
            /// The tracer's plan for the scene, with reasons.
            pub plan: Plan,
            /// What the caller chose.
            pub(super) options: CompileOptions,
        }

        /// The first id of every kind of primitive.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct First {
            $($(
                #[doc = concat!("Of [`Scene::", stringify!($storage), "`].")]
                pub $storage: u32,
            )*)*
        }

        impl Scene {
            /// The arrays of a sound description, without the tree.
            fn of(description: &Description, options: &CompileOptions) -> Self {
                $($(let mut $storage = stored(&description.$field);)*)*
                let mut next = 0;
                let mut first = |count: usize| {
                    next += count as u32;
                    next - count as u32
                };
                let first = First { $($($storage: first($storage.len()),)*)* };
                let mut boxes = Vec::new();
                $($(boxes.extend((0..$storage.len()).map_while(|i| super::$Kind::bounds(&$storage, i)));)*)*
                let plan = Plan::of(description, &boxes, options);
                $($(super::$Kind::set_methods(&mut $storage, &plan.methods);)*)*
                let (media, medium_of) = media(&description.materials);
                let mut scene = Self {
                    $($($storage,)*)*
                    first,
                    mesh_first: mesh_first(&description.meshes),
                    boxes,
                    bvh: None,
                    build_time: Duration::ZERO,
                    materials: description.materials.clone(),
                    media,
                    medium_of,
                    textures: description.textures.clone(),
                    poles: poles::poles(&description.materials, &description.textures),
                    lights: description.lights.clone(),
                    sky: description.sky.clone(),
                    settings: description.settings,
                    plan,
                    options: options.clone(),
                };
                scene.bound_media();
                scene
            }
        }
    };
}
for_each_kind! { scene }

impl Scene {
    /// The arrays of a description, without the tree.
    pub(super) fn without_tree(description: &Description, options: &CompileOptions) -> Result<Self, Invalid> {
        check(description)?;
        Ok(Self::of(description, options))
    }
}

/// Evaluates an expression for the primitive with an id, whatever its kind:
/// `with_primitive!(scene, id, |kind, i| kind.material(i))`, where `kind` is [`Primitives`] and `i` counts within it.
macro_rules! with_primitive {
    ($scene:expr, $id:expr, |$kind:ident, $i:ident| $body:expr) => {{
        let (scene, id): (&$crate::scene::Scene, u32) = ($scene, $id);
        $crate::kinds::for_each_kind! { with_primitive @list (scene, id, $kind, $i, $body) }
    }};
    (@list $to:tt unbounded { $($unbounded:tt)* } bounded { $($bounded:tt)* }) => {
        with_primitive! { @from $to $($unbounded)* $($bounded)* }
    };
    // It is of a kind when its id is below the next one's first.
    (@from ($scene:ident, $id:ident, $($to:tt)*) ($here:ident: $($_1:tt)*) ($next:ident: $($_2:tt)*) $($more:tt)*) => {
        if $id < $scene.first.$next {
            with_primitive! { @of ($scene, $id, $($to)*) $here }
        } else {
            with_primitive! { @from ($scene, $id, $($to)*) ($next: $($_2)*) $($more)* }
        }
    };
    (@from $to:tt ($last:ident: $($_1:tt)*)) => {
        with_primitive! { @of $to $last }
    };
    (@of ($scene:ident, $id:ident, $kind:ident, $i:ident, $body:expr) $here:ident) => {{
        let ($kind, $i) = (&$scene.$here, ($id - $scene.first.$here) as usize);
        $body
    }};
}
pub(crate) use with_primitive;

/// Compiles a description into SoA arrays, for rays that start at the eye, at lights and on surfaces: where the plan has a
/// cheaper method for spheres, it vouches for no others. [`compile_with`] can ask for the stable one.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile(description: &Description) -> Result<Scene, Invalid> {
    compile_with(description, &CompileOptions::default())
}

/// Compiles a description with the caller's choices in place of the plan's.
///
/// # Errors
/// [`Invalid`] when [`check`] finds fault with it.
pub fn compile_with(description: &Description, options: &CompileOptions) -> Result<Scene, Invalid> {
    let mut scene = Scene::without_tree(description, options)?;
    if scene.plan.structure == Structure::Tree {
        let started = Instant::now();
        scene.bvh = Some(Bvh::build(&InTree(&scene)));
        scene.build_time = started.elapsed();
    }
    Ok(scene)
}

/// The arrays of a kind's elements.
fn stored<K: Kind>(elements: &[K]) -> K::Storage {
    let mut storage = K::Storage::default();
    elements.iter().for_each(|element| element.store(&mut storage));
    storage
}

/// The first triangle of every mesh ([`Scene::mesh_first`]).
fn mesh_first(meshes: &[Mesh]) -> Vec<u32> {
    let begin = |next: &mut u32, mesh: &Mesh| {
        let first = *next;
        *next += mesh.triangles.len() as u32;
        Some(first)
    };
    meshes.iter().scan(0, begin).collect()
}
