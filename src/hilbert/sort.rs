//! Elements sorted by the keys in their upper halves; ties by the lower halves.

use super::curve::KEY_BITS;
use std::ops::Range;

/// Bits of the first partition.
const FIRST_DIGIT: u32 = 12;
/// Bits of the others at most: their counters stay in the first cache.
const DIGIT: u32 = 10;
/// As many elements are sorted by comparing them, without being parted before.
const FEW: usize = 8;

/// Sorts; and says where more than [`FEW`] have one key.
pub(super) fn sort(elements: &mut [u64]) -> Vec<Range<usize>> {
    let mut crowds = Vec::new();
    let mut other = vec![0; elements.len()];
    let mut ends = vec![0; 1 << FIRST_DIGIT];
    partition(elements, &mut other, KEY_BITS - FIRST_DIGIT, &mut ends);
    for run in runs(&ends) {
        let into = &mut elements[run.clone()];
        refine(&mut other[run.clone()], into, KEY_BITS - FIRST_DIGIT, run.start, &mut crowds);
    }
    crowds
}

/// Sorts `from`, which begins at that place of all, into `into`, by the last `bits` bits of the keys; the others are equal.
/// Where more than [`FEW`] have one key is put into `crowds`.
fn refine(from: &mut [u64], into: &mut [u64], bits: u32, place: usize, crowds: &mut Vec<Range<usize>>) {
    if from.len() <= FEW || bits == 0 {
        into.copy_from_slice(from);
        if bits == 0 && from.len() > FEW {
            crowds.push(place..place + from.len());
        } else {
            insert(into);
        }
        return;
    }
    // Less than one point a run where they are strewn evenly.
    let digit = (from.len().ilog2() + 1).min(DIGIT).min(bits);
    let mut ends = [0; 1 << DIGIT];
    let ends = &mut ends[..1 << digit];
    partition(from, into, bits - digit, ends);
    for run in runs(ends).filter(|run| run.len() > FEW) {
        refine(&mut into[run.clone()], &mut from[run.clone()], bits - digit, place + run.start, crowds);
        into[run.clone()].copy_from_slice(&from[run]);
    }
    // No element has far to go.
    insert(into);
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

/// Copies `from` to `to` in the order of the keys' bits from bit `shift` on, of which `ends` has one number for each value:
/// zeros, and afterwards where the run with that value ends. Equal ones keep their order.
fn partition(from: &[u64], to: &mut [u64], shift: u32, ends: &mut [u32]) {
    let mask = ends.len() - 1;
    let digit = |element: u64| (element >> (32 + shift)) as usize & mask;
    for &element in from {
        ends[digit(element)] += 1;
    }
    let mut first = 0;
    for end in ends.iter_mut() {
        (first, *end) = (first + *end, first);
    }
    for &element in from {
        let place = &mut ends[digit(element)];
        to[*place as usize] = element;
        *place += 1;
    }
}

/// Places of the runs that are not empty.
fn runs(ends: &[u32]) -> impl Iterator<Item = Range<usize>> {
    let begins = std::iter::once(0).chain(ends.iter().copied());
    begins.zip(ends).map(|(begin, &end)| begin as usize..end as usize).filter(|run| !run.is_empty())
}
