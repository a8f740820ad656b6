//! Numbers in the lines of OBJ and MTL files.

/// Up to N numbers, and how many words there are; more than eight are not looked at.
pub(super) fn numbers<'w, const N: usize>(words: impl Iterator<Item = &'w str>) -> Result<([f32; N], usize), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    for word in words.take(8) {
        let number = word.parse().map_err(|_| format!("not a number: {word}"))?;
        if let Some(place) = numbers.get_mut(count) {
            *place = number;
        }
        count += 1;
    }
    Ok((numbers, count))
}
