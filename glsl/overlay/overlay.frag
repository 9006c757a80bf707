// The overlay: its colours are sRGB, premultiplied, and are blended encoded, as the picture below is and as egui's are
// meant to be.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared.glsl"
#include "lib/tonemap.glsl"

layout(set = SET_overlay, binding = OVERLAY_TEXTURE) uniform sampler2D image;
layout(constant_id = 61) const uint ENCODING = 0u;
layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 tint;
layout(location = 0) out vec4 color;

vec3 srgb_decode(vec3 c) {
    return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

void main() {
    color = tint * texture(image, uv);
    if (ENCODING == ENCODING_SRGB) return;
    // Below half a step of 8 bits there is no colour to speak of.
    vec3 c = srgb_decode(clamp(color.rgb / max(color.a, 1.0 / 512.0), 0.0, 1.0));
    color.rgb = (ENCODING == ENCODING_SCRGB ? scrgb_encode(c) : hdr10_encode(c)) * color.a;
}
