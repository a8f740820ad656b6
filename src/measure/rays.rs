//! Ray files: little-endian `f32`, eight a ray: origin xyz, t_min, direction xyz, t_max; t_max < 0 marks an
//! inactive ray.

use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use crate::files;
use crate::math::{BATCH, RayBatch};
use glam::Vec3;

/// Bytes a ray.
const RECORD: usize = 32;

/// How far the square of a direction's length may be from 1.
const UNIT: f32 = 1e-5;

/// Why a ray file cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RayFileError {
    /// The file cannot be read, or is none: a pipe, a device or a folder.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's error.
        source: std::io::Error,
    },
    /// The file does not end with a whole record.
    #[error("{}: {bytes} bytes are not a whole number of {RECORD}-byte rays", path.display())]
    Length {
        /// The file.
        path: PathBuf,
        /// Its size.
        bytes: u64,
    },
    /// A file without an active ray.
    #[error("{}: no active ray", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// A ray that is none.
    #[error("{}: ray {index}: {problem}", path.display())]
    Ray {
        /// The file.
        path: PathBuf,
        /// Counted from 0.
        index: u64,
        /// The problem.
        problem: String,
    },
}

/// Reads a ray file into batches of [`BATCH`] rays in the file's order.
///
/// # Errors
/// [`RayFileError`] when the file cannot be read, is cut off, or has an active ray whose direction is not of length
/// 1 or whose numbers are not finite (t_max may be infinite).
pub fn read(path: &Path) -> Result<Vec<RayBatch>, RayFileError> {
    let io = |source| RayFileError::Io { path: path.into(), source };
    let (file, meta) = files::open(path).map_err(io)?;
    let bytes = meta.len();
    if bytes % RECORD as u64 != 0 {
        return Err(RayFileError::Length { path: path.into(), bytes });
    }
    let count = bytes / RECORD as u64;
    let mut reader = BufReader::with_capacity(1 << 20, file);
    let mut batches: Vec<RayBatch> = Vec::new();
    for index in 0..count {
        let mut record = [0; RECORD];
        reader.read_exact(&mut record).map_err(io)?;
        if index % BATCH as u64 == 0 {
            batches.push(RayBatch::default());
        }
        let n: [f32; 8] =
            std::array::from_fn(|i| f32::from_le_bytes(record[4 * i..4 * i + 4].try_into().expect("four bytes")));
        let batch = batches.last_mut().expect("one was just pushed");
        if n[7] < 0.0 {
            batch.push_inactive();
            continue;
        }
        check(&n).map_err(|problem| RayFileError::Ray { path: path.into(), index, problem })?;
        batch.push(Vec3::new(n[0], n[1], n[2]), Vec3::new(n[4], n[5], n[6]), n[3], n[7]);
    }
    if batches.iter().all(|b| b.active() == 0) {
        return Err(RayFileError::Empty { path: path.into() });
    }
    Ok(batches)
}

/// Says what is wrong with an active record.
fn check(n: &[f32; 8]) -> Result<(), String> {
    if let Some(bad) = n[..7].iter().find(|v| !v.is_finite()) {
        return Err(format!("{bad} is not a finite number"));
    }
    if n[7].is_nan() {
        return Err("t_max is not a number".into());
    }
    if n[3] < 0.0 {
        return Err(format!("t_min must not be below 0, got {}", n[3]));
    }
    let length2 = Vec3::new(n[4], n[5], n[6]).length_squared();
    if (length2 - 1.0).abs() > UNIT {
        return Err(format!("the direction must have length 1, got {}", length2.sqrt()));
    }
    Ok(())
}

/// Writes batches as [`read`] reads them, and gives the number of active rays in them. All but the last are filled up with
/// inactive rays, so that they come back as the same batches. A ray of numbers that `read` would not take is inactive in
/// the file; it hits nothing.
///
/// # Errors
/// When `to` cannot be written.
pub fn write(batches: &[RayBatch], to: &mut impl Write) -> io::Result<u64> {
    let mut active = 0;
    for (i, batch) in batches.iter().enumerate() {
        let len = if i + 1 == batches.len() { batch.len } else { BATCH };
        for ray in 0..len {
            let record = record(batch, ray).unwrap_or(INACTIVE);
            active += u64::from(record[7] >= 0.0);
            for number in record {
                to.write_all(&number.to_le_bytes())?;
            }
        }
    }
    Ok(active)
}

/// An inactive ray's record.
const INACTIVE: [f32; 8] = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0];

/// An active ray's record.
fn record(batch: &RayBatch, ray: usize) -> Option<[f32; 8]> {
    if ray >= batch.len || batch.t_max[ray].is_nan() || batch.t_max[ray] < 0.0 {
        return None;
    }
    let [x, y, z] = batch.origin.map(|column| column[if batch.common_origin { 0 } else { ray }]);
    let [u, v, w] = batch.direction.map(|column| column[ray]);
    let record = [x, y, z, batch.t_min[ray], u, v, w, batch.t_max[ray]];
    check(&record).is_ok().then_some(record)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(rays: &[[f32; 8]], extra: usize) -> tempfile::NamedTempFile {
        let mut file = tempfile::NamedTempFile::new().unwrap();
        for n in rays.iter().flatten() {
            file.write_all(&n.to_le_bytes()).unwrap();
        }
        file.write_all(&vec![0; extra]).unwrap();
        file
    }

    const GOOD: [f32; 8] = [1.0, 2.0, 3.0, 0.0, 0.0, 0.6, 0.8, 1e30];

    #[test]
    fn rays_come_back_in_order() {
        let mut rays = vec![GOOD; 300];
        rays[257][7] = -1.0;
        rays[258][0] = 9.0;
        let batches = read(file(&rays, 0).path()).unwrap();
        assert_eq!(batches.iter().map(|b| b.len).collect::<Vec<_>>(), [256, 44]);
        assert_eq!(batches.iter().map(RayBatch::active).sum::<usize>(), 299);
        assert_eq!((batches[1].origin[0][2], batches[1].direction[1][2], batches[1].t_max[1]), (9.0, 0.6, -1.0));
        assert!(batches[0].common_origin && !batches[1].common_origin);
    }

    #[test]
    fn what_is_written_comes_back() {
        let mut batches = vec![RayBatch::default(); 2];
        for i in 0..5 {
            batches[0].push(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.0, 0.6, 0.8), 0.5, i as f32);
            batches[1].push(Vec3::new(i as f32, 2.0, 3.0), Vec3::new(0.8, 0.6, 0.0), 0.0, f32::INFINITY);
        }
        batches[0].push_inactive();
        batches[1].push(Vec3::NAN, Vec3::X, 0.0, 1.0);
        assert!(batches[0].common_origin);
        let mut bytes = Vec::new();
        assert_eq!(write(&batches, &mut bytes).unwrap(), 10);
        assert_eq!(bytes.len(), RECORD * (BATCH + 6));
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(&bytes).unwrap();
        let back = read(file.path()).unwrap();
        assert_eq!(back.iter().map(RayBatch::active).collect::<Vec<_>>(), [5, 5]);
        assert_eq!(back.iter().map(|b| b.common_origin).collect::<Vec<_>>(), [true, false]);
        for (batch, back) in batches.iter().zip(&back) {
            for i in 0..5 {
                assert_eq!(record(batch, i), record(back, i), "{i}");
                assert!(record(batch, i).is_some());
            }
            assert_eq!(record(back, 5), None);
        }
    }

    #[test]
    fn errors_name_the_file_and_the_ray() {
        let message = |rays: &[[f32; 8]], extra| {
            let file = file(rays, extra);
            let text = read(file.path()).unwrap_err().to_string();
            text.replace(&file.path().display().to_string(), "FILE")
        };
        assert_eq!(message(&[GOOD], 5), "FILE: 37 bytes are not a whole number of 32-byte rays");
        let mut bad = GOOD;
        bad[5] = 0.0;
        assert_eq!(message(&[GOOD, bad], 0), "FILE: ray 1: the direction must have length 1, got 0.8");
        bad = GOOD;
        bad[1] = f32::NAN;
        assert_eq!(message(&[bad], 0), "FILE: ray 0: NaN is not a finite number");
        bad = GOOD;
        bad[7] = f32::NAN;
        assert_eq!(message(&[bad], 0), "FILE: ray 0: t_max is not a number");
        bad = GOOD;
        bad[3] = -1.0;
        assert_eq!(message(&[bad], 0), "FILE: ray 0: t_min must not be below 0, got -1");
        bad[7] = -1.0;
        assert_eq!(message(&[bad], 0), "FILE: no active ray");
        assert_eq!(message(&[], 0), "FILE: no active ray");
        assert_eq!(read(Path::new("/dev/null")).unwrap_err().to_string(), "/dev/null: not a regular file");
        assert!(read(Path::new("nowhere.primary")).unwrap_err().to_string().starts_with("nowhere.primary: "));
    }
}
