//! Radiance pictures (`.hdr`): four bytes a pixel, red, green and blue with an exponent in common.
//!
//! As Radiance's `color.c` writes them, and Ward's "Real Pixels" (Graphics Gems II, 1991) explains: plain, in the old
//! runs, and in the runs by channel that all programs write now. The decoder of the `image` crate, at 0.25.10,
//! multiplies the lengths of old runs until they overflow.

/// The most lines before the one with the size.
const MAX_LINES: usize = 1000;

/// Whether these are the first bytes of such a file.
pub(super) fn is_radiance(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#?RADIANCE") || bytes.starts_with(b"#?RGBE")
}

/// The bytes of a file that are still to be read.
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or("ends too early")?;
        self.0 = rest;
        Ok(taken)
    }

    fn four(&mut self) -> Result<[u8; 4], String> {
        Ok(*self.take(4)?.first_chunk().expect("four were taken"))
    }

    fn line(&mut self) -> Result<&'a [u8], String> {
        let end = self.0.iter().position(|b| *b == b'\n').ok_or("ends too early")?;
        let line = &self.take(end + 1)?[..end];
        Ok(line.strip_suffix(b"\r").unwrap_or(line))
    }
}

/// Width, height and linear RGB; `fits` says whether the size is allowed.
///
/// `EXPOSURE` and `COLORCORR` are not looked at, as in most programs: the numbers count as they stand. Only the usual
/// order of pixels is read, from the top left, row by row.
pub(super) fn decode(
    bytes: &[u8],
    fits: impl FnOnce(u32, u32) -> Result<(), String>,
) -> Result<(usize, usize, Vec<[f32; 3]>), String> {
    let mut bytes = Bytes(bytes);
    let (width, height) = header(&mut bytes)?;
    fits(width, height)?;
    let (width, height) = (width as usize, height as usize);
    // A row takes at least 4 bytes, whatever it holds; so a short file does not get the memory of a large picture.
    if bytes.0.len() < 4 * height {
        return Err("ends too early".into());
    }
    let mut texels = Vec::with_capacity(width * height);
    let mut row = vec![[0; 4]; width];
    for _ in 0..height {
        let first = bytes.four()?;
        match first {
            [2, 2, high, low] if high < 128 => {
                if usize::from(high) << 8 | usize::from(low) != width {
                    return Err("a row is not as wide as the picture".into());
                }
                (0..4).try_for_each(|channel| runs(&mut bytes, &mut row, channel))?;
            }
            _ => old_runs(&mut bytes, &mut row, first)?,
        }
        texels.extend(row.iter().map(|&pixel| linear(pixel)));
    }
    Ok((width, height, texels))
}

fn header(bytes: &mut Bytes<'_>) -> Result<(u32, u32), String> {
    for _ in 0..MAX_LINES {
        let line = bytes.line()?;
        if line.is_empty() {
            return size(bytes.line()?);
        }
        if line.strip_prefix(b"FORMAT=").is_some_and(|format| format.trim_ascii() != b"32-bit_rle_rgbe") {
            return Err("only FORMAT=32-bit_rle_rgbe can be read".into());
        }
    }
    Err(format!("the header is longer than {MAX_LINES} lines"))
}

/// The line `-Y height +X width`.
fn size(line: &[u8]) -> Result<(u32, u32), String> {
    let line = String::from_utf8_lossy(line);
    let words: Vec<&str> = line.split_ascii_whitespace().take(5).collect();
    let number = |word: &str| word.parse().map_err(|_| format!("not a size: {word}"));
    match words[..] {
        ["-Y", height, "+X", width] => Ok((number(width)?, number(height)?)),
        _ => Err(format!("the size must be -Y height +X width, got {line}")),
    }
}

/// One channel of a row: 128 + n and a byte stand for n of it, n up to 128 for the n bytes that follow.
fn runs(bytes: &mut Bytes<'_>, row: &mut [[u8; 4]], channel: usize) -> Result<(), String> {
    let mut at = 0;
    while at < row.len() {
        let length = usize::from(bytes.take(1)?[0]);
        let (length, values) =
            if length > 128 { (length - 128, bytes.take(1)?) } else { (length, bytes.take(length)?) };
        let run = row.get_mut(at..at + length).ok_or("a run is longer than its row")?;
        let values = values.iter().cycle();
        run.iter_mut().zip(values).for_each(|(pixel, value)| pixel[channel] = *value);
        at += length;
    }
    Ok(())
}

/// A row of whole pixels: 1, 1, 1, n repeats the last one n times, and directly after another such, 256 n times.
fn old_runs(bytes: &mut Bytes<'_>, row: &mut [[u8; 4]], first: [u8; 4]) -> Result<(), String> {
    let mut next = first;
    let (mut at, mut shift) = (0_usize, 0);
    loop {
        if let [1, 1, 1, count] = next {
            let last = *at.checked_sub(1).and_then(|i| row.get(i)).ok_or("a row starts with a run")?;
            // From the third in a row on, any is too long.
            let length = usize::from(count) << shift.min(16);
            row.get_mut(at..at + length).ok_or("a run is longer than its row")?.fill(last);
            (at, shift) = (at + length, shift + 8);
        } else {
            row[at] = next;
            (at, shift) = (at + 1, 0);
        }
        if at == row.len() {
            return Ok(());
        }
        next = bytes.four()?;
    }
}

/// The mantissas are parts of 256, the exponent counts from 128.
fn linear([r, g, b, exponent]: [u8; 4]) -> [f32; 3] {
    // Two steps, since 2⁻¹³⁵ is no `f32`: the product is subnormal, or 0, where it has to be.
    let scale = if exponent == 0 { 0.0 } else { 2f32.powi(i32::from(exponent) - 128) };
    [r, g, b].map(|mantissa| f32::from(mantissa) / 256.0 * scale)
}

#[cfg(test)]
#[path = "radiance_tests.rs"]
mod tests;
