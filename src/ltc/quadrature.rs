//! Adaptive Gauss–Kronrod quadrature of several integrands at once.

/// Abscissae of the 15-point Kronrod rule on [0, 1), from the outside in; odd ones are those of the 7-point Gauss rule.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_83,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_67, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// ∫ `f` over [`from`, `to`], each component to about `tolerance`; halves an interval at most `depth` times.
pub(super) fn integrate<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    [from, to]: [f64; 2],
    tolerance: f64,
    depth: u32,
) -> [f64; N] {
    if to <= from {
        return [0.0; N];
    }
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut fine, mut coarse) = ([0.0; N], [0.0; N]);
    for (i, node) in NODES.into_iter().enumerate() {
        let sides: &[f64] = if node == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
        for side in sides {
            let value = f(middle + side * node * half);
            for n in 0..N {
                fine[n] += half * KRONROD[i] * value[n];
                if i % 2 == 1 {
                    coarse[n] += half * GAUSS[i / 2] * value[n];
                }
            }
        }
    }
    let error = (0..N).map(|n| (fine[n] - coarse[n]).abs()).fold(0.0, f64::max);
    if depth == 0 || error <= tolerance {
        return fine;
    }
    let left = integrate(f, [from, middle], 0.5 * tolerance, depth - 1);
    let right = integrate(f, [middle, to], 0.5 * tolerance, depth - 1);
    std::array::from_fn(|n| left[n] + right[n])
}
