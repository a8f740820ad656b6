//! From the corners of faces, which number position, texture coordinates and normal apart, to the vertices of a mesh.

use std::collections::{HashMap, TryReserveError};

use glam::{Vec2, Vec3};

use crate::scene::Mesh;

/// No texture coordinates, or no normal.
pub(super) const NONE: u32 = u32::MAX;

/// Indices, from 0, of a position, texture coordinates and a normal.
pub(super) type Triple = [u32; 3];

/// The columns of the file.
#[derive(Default)]
pub(super) struct Columns {
    pub positions: Vec<Vec3>,
    pub uvs: Vec<Vec2>,
    /// Unit vectors, or zero where the file gives that.
    pub normals: Vec<Vec3>,
}

/// The vertices so far. As long as no face has more than positions, the positions are the vertices.
#[derive(Default)]
pub(super) struct Vertices {
    triples: Vec<Triple>,
    known: HashMap<Triple, u32>,
    several: bool,
}

impl Vertices {
    /// The vertices of a face, in place of what its corners name. `triangles` are those of the faces before.
    pub fn of_face(&mut self, face: &[Triple], triangles: &mut [[u32; 3]], vertices: &mut Vec<u32>) {
        if !self.several && face.iter().any(|[_, uv, normal]| [*uv, *normal] != [NONE; 2]) {
            self.several = true;
            triangles.as_flattened_mut().iter_mut().for_each(|v| *v = self.find([*v, NONE, NONE]));
        }
        vertices.clear();
        vertices.extend(face.iter().map(|triple| if self.several { self.find(*triple) } else { triple[0] }));
    }

    /// For so many corners more.
    pub fn make_room(&mut self, corners: usize) -> Result<(), TryReserveError> {
        if !self.several {
            return Ok(());
        }
        self.triples.try_reserve(corners)?;
        self.known.try_reserve(corners)
    }

    /// For what [`Vertices::mesh`] makes.
    pub fn room_for_mesh(&self, columns: &Columns) -> Result<(), TryReserveError> {
        let uv = if columns.uvs.is_empty() { 0 } else { size_of::<Vec2>() };
        let normal = if columns.normals.is_empty() { 0 } else { size_of::<Vec3>() };
        let vertices = if self.several { self.triples.len() } else { 0 };
        Vec::<u8>::new().try_reserve_exact(vertices * (size_of::<Vec3>() + uv + normal))
    }

    /// The index of the position of a vertex.
    pub fn position(&self, vertex: u32) -> usize {
        if self.several { self.triples[vertex as usize][0] as usize } else { vertex as usize }
    }

    fn find(&mut self, triple: Triple) -> u32 {
        *self.known.entry(triple).or_insert_with(|| {
            self.triples.push(triple);
            (self.triples.len() - 1) as u32
        })
    }

    /// The mesh. Where some corners have a normal, the others get that of their triangle; where some have texture
    /// coordinates, the others get (0, 0).
    pub fn mesh(self, mut columns: Columns, mut triangles: Vec<[u32; 3]>) -> Mesh {
        let Self { mut triples, known, several } = self;
        drop(known);
        if !several {
            return Mesh { positions: columns.positions, triangles, ..Mesh::default() };
        }
        // A normal of length zero counts as none.
        for [.., normal] in &mut triples {
            if columns.normals.get(*normal as usize).is_none_or(|n| *n == Vec3::ZERO) {
                *normal = NONE;
            }
        }
        let has_normals = triples.iter().any(|t| t[2] != NONE);
        if has_normals {
            triangles.iter_mut().for_each(|triangle| give_normal(triangle, &mut triples, &mut columns));
        }
        let has_uvs = triples.iter().any(|t| t[1] != NONE);
        let Columns { positions, uvs, normals } = columns;
        let each = |wanted: bool| if wanted { &triples[..] } else { &[] };
        Mesh {
            // Vertices that lost their triangles to ones with a normal keep any direction.
            normals: each(has_normals).iter().map(|t| normals.get(t[2] as usize).copied().unwrap_or(Vec3::Y)).collect(),
            uvs: each(has_uvs).iter().map(|t| uvs.get(t[1] as usize).copied().unwrap_or_default()).collect(),
            positions: triples.iter().map(|t| positions[t[0] as usize]).collect(),
            triangles,
            ..Mesh::default()
        }
    }
}

/// Gives the corners without a normal that of the triangle, as vertices of their own.
fn give_normal(triangle: &mut [u32; 3], triples: &mut Vec<Triple>, columns: &mut Columns) {
    if triangle.iter().all(|v| triples[*v as usize][2] != NONE) {
        return;
    }
    let [a, b, c] = triangle.map(|v| columns.positions[triples[v as usize][0] as usize].as_dvec3());
    // What has no area is never seen.
    columns.normals.push((b - a).cross(c - a).normalize_or(glam::DVec3::Y).as_vec3());
    let normal = (columns.normals.len() - 1) as u32;
    for vertex in triangle {
        let [position, uv, own] = triples[*vertex as usize];
        if own == NONE {
            triples.push([position, uv, normal]);
            *vertex = (triples.len() - 1) as u32;
        }
    }
}
