//! Indices sorted by their keys; ties by the indices.

use crate::shared::HILBERT_KEY_BITS as KEY_BITS;
use std::ops::Range;

/// Bits of the first partition.
const FIRST_DIGIT: u32 = 12;
/// Bits of the others at most: their counters stay in the first cache.
const DIGIT: u32 = 10;
/// As many elements are sorted by comparing them, without being parted before.
const FEW: usize = 8;

/// Indices of the keys in their order, and where more than [`FEW`] have one key.
///
/// The indices take the keys' place, and runs are parted to and fro in a core's own cache: 2²⁰ indices of fresh memory take the
/// system 1.8 CPU ms, 36 instead of 32 CPU ms with twice as much of it. Points that move with their keys are no faster (order
/// and lights in it 58 CPU ms, 67 so; but 40 where the order alone is asked for).
pub(crate) fn sort(mut keys: Vec<u32>) -> (Vec<u32>, Vec<Range<usize>>) {
    let shift = KEY_BITS - FIRST_DIGIT;
    let mut ends = vec![0; 1 << FIRST_DIGIT];
    count(&keys, |key| (key >> shift) as usize, &mut ends);
    let mut elements = vec![0_u64; keys.len()];
    for (index, &key) in (0..).zip(&keys) {
        let place = &mut ends[(key >> shift) as usize];
        elements[*place as usize] = u64::from(key) << 32 | index;
        *place += 1;
    }
    let (mut crowds, mut other) = (Vec::new(), Vec::new());
    for run in runs(&ends) {
        let elements = &mut elements[run.clone()];
        other.resize(other.len().max(run.len()), 0);
        refine(elements, &mut other[..run.len()], shift, run.start, &mut crowds);
        for (index, element) in keys[run].iter_mut().zip(elements) {
            *index = *element as u32;
        }
    }
    (keys, crowds)
}

/// Sorts elements, keys with indices below them, which begin at that place of all, by the last `bits` bits of the keys; the
/// others are equal. `other` is as long. Where more than [`FEW`] have one key is put into `crowds`.
fn refine(elements: &mut [u64], other: &mut [u64], bits: u32, place: usize, crowds: &mut Vec<Range<usize>>) {
    if elements.len() <= FEW || bits == 0 {
        if bits == 0 && elements.len() > FEW {
            crowds.push(place..place + elements.len());
        } else {
            insert(elements);
        }
        return;
    }
    // Less than one point a run where they are strewn evenly.
    let digit = (elements.len().ilog2() + 1).min(DIGIT).min(bits);
    let of = |element: u64| (element >> (32 + bits - digit)) as usize & ((1 << digit) - 1);
    let mut ends = [0; 1 << DIGIT];
    let ends = &mut ends[..1 << digit];
    let most = count(elements, of, ends);
    other.copy_from_slice(elements);
    for &element in &*other {
        let place = &mut ends[of(element)];
        elements[*place as usize] = element;
        *place += 1;
    }
    if most > FEW {
        for run in runs(ends).filter(|run| run.len() > FEW) {
            refine(
                &mut elements[run.clone()],
                &mut other[run.clone()],
                bits - digit,
                place + run.start,
                crowds,
            );
        }
    }
    // No element has far to go.
    insert(elements);
}

/// Sorts by insertion.
fn insert(elements: &mut [u64]) {
    for i in 1..elements.len() {
        let element = elements[i];
        let mut place = i;
        while place > 0 && elements[place - 1] > element {
            elements[place] = elements[place - 1];
            place -= 1;
        }
        elements[place] = element;
    }
}

/// Where the run of each digit begins, into zeros; how long the longest is.
fn count<T: Copy>(elements: &[T], digit: impl Fn(T) -> usize, begins: &mut [u32]) -> usize {
    for &element in elements {
        begins[digit(element)] += 1;
    }
    let (mut first, mut most) = (0, 0);
    for begin in begins {
        most = most.max(*begin);
        (first, *begin) = (first + *begin, first);
    }
    most as usize
}

/// Places of the runs that are not empty.
fn runs(ends: &[u32]) -> impl Iterator<Item = Range<usize>> {
    let begins = std::iter::once(0).chain(ends.iter().copied());
    begins.zip(ends).map(|(begin, &end)| begin as usize..end as usize).filter(|run| !run.is_empty())
}
