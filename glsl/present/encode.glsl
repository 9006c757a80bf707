// Tone curve and encoding; no dithering.
#ifndef PRESENT_ENCODE_GLSL
#define PRESENT_ENCODE_GLSL

#include "lib/tonemap.glsl"

layout(constant_id = 10) const uint TONEMAP = 0u;
layout(constant_id = 61) const uint ENCODING = 0u;

vec4 encoded(vec3 c) {
    if (TONEMAP == 1u) c = aces(c);
    if (TONEMAP == 2u) c = agx(c);
    if (ENCODING == ENCODING_SRGB) c = srgb_encode(c);
    if (ENCODING == ENCODING_SCRGB) c = scrgb_encode(c);
    if (ENCODING == ENCODING_HDR10) c = hdr10_encode(c);
    return vec4(c, 1.0);
}

#endif
