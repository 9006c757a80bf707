// Tone curves: scene-linear Rec.709 to display-linear, where 1 is white, and the encodings of displays.
#ifndef LIB_TONEMAP_GLSL
#define LIB_TONEMAP_GLSL

vec3 srgb_encode(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}

// Luminance of white on a display of high dynamic range, cd/m² (ITU-R BT.2408); its brightest.
const float WHITE = 203.0;
const float PEAK = 10000.0;

// IEC 61966-2-2 without its offset: linear, 1 is 80 cd/m².
vec3 scrgb_encode(vec3 c) {
    return clamp(c * WHITE, 0.0, PEAK) / 80.0;
}

// Rec. 709 to Rec. 2020 primaries (ITU-R BT.2087), then the perceptual quantizer (SMPTE ST 2084).
vec3 hdr10_encode(vec3 c) {
    const mat3 to_2020 = mat3(
            0.627403896, 0.069097289, 0.016391439,  //
            0.329283038, 0.919540395, 0.088013308,  //
            0.043313066, 0.011362316, 0.895595253);
    // Below the bound its powers stay finite.
    vec3 y = clamp(to_2020 * min(c, vec3(1e6)) * (WHITE / PEAK), 0.0, 1.0);
    vec3 p = pow(y, vec3(0.1593017578125));
    return pow((0.8359375 + 18.8515625 * p) / (1.0 + 18.6875 * p), vec3(78.84375));
}

// ACES RRT and sRGB ODT, the rational fit of Hill.
vec3 aces(vec3 c) {
    const mat3 to_rrt = mat3(
            0.59719, 0.07600, 0.02840,  //
            0.35458, 0.90834, 0.13383,  //
            0.04823, 0.01566, 0.83777);
    const mat3 to_display = mat3(
            1.60475, -0.10208, -0.00327,  //
            -0.53108, 1.10813, -0.07276,  //
            -0.07367, -0.00605, 1.07602);
    // Above this the curve is flat; without the bound its square overflows.
    vec3 v = to_rrt * min(c, vec3(1e6));
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(to_display * v, 0.0, 1.0);
}

// AgX (Sobotka), base look: log2 encoding over 16.5 stops, then the sigmoid as a polynomial of degree 6.
vec3 agx(vec3 c) {
    const mat3 inset = mat3(
            0.842479062253094, 0.0423282422610123, 0.0423756549057051,  //
            0.0784335999999992, 0.878468636469772, 0.0784336,           //
            0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const mat3 outset = mat3(
            1.19687900512017, -0.0528968517574562, -0.0529716355144438,  //
            -0.0980208811401368, 1.15190312990417, -0.0980434501171241,  //
            -0.0990297440797205, -0.0989611768448433, 1.15107367264116);
    const float least = -12.47393;
    const float most = 4.026069;
    vec3 v = (clamp(log2(max(inset * c, vec3(1e-10))), least, most) - least) / (most - least);
    vec3 v2 = v * v;
    vec3 v4 = v2 * v2;
    v = 15.5 * v4 * v2 - 40.14 * v4 * v + 31.96 * v4 - 6.868 * v2 * v + 0.4298 * v2 + 0.1191 * v - 0.00232;
    // The polynomial approximates a display-encoded curve: back to linear.
    return pow(max(outset * v, vec3(0.0)), vec3(2.2));
}

#endif
