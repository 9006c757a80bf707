// A line light as it is seen: the strip between the tangent planes of its cylinder, in longitude and latitude about its
// axis. Any linear map of space keeps it between two planes through the axis, so that it is a box but for its ends.
#ifndef LIB_AREA_STRIP_GLSL
#define LIB_AREA_STRIP_GLSL

#include "lib/area/quadrature.glsl"

// Relative to the shaded point, in local coordinates: corner + s across + t along, s and t in [0, 1].
struct Strip {
    bool seen;
    vec3 corner;
    vec3 across;
    vec3 along;
};

// An open cylinder from `start` along `axis`, cut where it goes below the horizon; unseen from inside. Each end is an
// arc: the strip ends where it has the arc's area.
Strip strip_of_line(vec3 start, vec3 axis, float radius) {
    Strip strip;
    // Where the axis is a radius below the horizon, the rim may still touch it.
    float lift = start.z + radius;
    float end_lift = lift + axis.z;
    vec3 cut = start + axis * (lift / (lift - end_lift));
    vec3 a = lift < 0.0 ? cut : start;
    vec3 b = end_lift < 0.0 ? cut : start + axis;
    float length = sqrt(max(dot(axis, axis), TINY));
    vec3 e = axis / length;
    vec3 out_vector = start - dot(start, e) * e;
    float d = sqrt(dot(out_vector, out_vector));
    strip.seen = d > radius && max(lift, end_lift) > 0.0;
    vec3 towards = out_vector / max(d, TINY);
    float ratio = min(radius / max(d, TINY), 1.0 - 1e-6);
    float rest = sqrt((1.0 - ratio) * (1.0 + ratio));
    vec3 side = cross(e, towards) * (radius * rest);
    // On the plane of both tangents the nearest point of a rim appears farther along the axis by 1 + R/d, and the rim
    // between is nearly an ellipse.
    float bulge = 1.0 + 0.25 * PI * ratio;
    strip.corner = towards * (d * rest * rest) + side + e * (dot(a, e) * bulge);
    strip.across = -2.0 * side;
    strip.along = (b - a) * bulge;
    return strip;
}

// A strip in the space of a proxy.
struct StripImage {
    vec3 corner;
    vec3 across;
    vec3 along;
    mat3 axes;        // columns: towards the middle, across, along
    vec2 longitudes;  // of both sides
};

StripImage strip_image(Strip strip, Proxy proxy) {
    StripImage image;
    image.corner = proxy.q_from_local * strip.corner;
    image.across = proxy.q_from_local * strip.across;
    image.along = proxy.q_from_local * strip.along;
    vec3 e = image.along * inversesqrt(max(dot(image.along, image.along), TINY));
    vec3 middle = image.corner + 0.5 * image.across;
    vec3 x = middle - e * dot(middle, e);
    x *= inversesqrt(max(dot(x, x), TINY));
    image.axes = mat3(x, cross(e, x), e);
    vec2 first = (image.corner * image.axes).xy;
    vec2 last = ((image.corner + image.across) * image.axes).xy;
    image.longitudes = vec2(atan(first.y, first.x), atan(last.y, last.x));
    return image;
}

// A meridian of the image: its direction across the axis, and the latitudes of its ends.
struct Meridian {
    vec3 towards;
    vec2 latitudes;
};

Meridian strip_meridian(StripImage image, float longitude) {
    float c = cos(longitude);
    float s = sin(longitude);
    Meridian meridian;
    meridian.towards = image.axes[0] * c + image.axes[1] * s;
    vec3 normal = image.axes[1] * c - image.axes[0] * s;
    float span = dot(image.across, normal);
    float at = abs(span) > 0.0 ? clamp(-dot(image.corner, normal) / span, 0.0, 1.0) : 0.5;
    vec3 a = image.corner + at * image.across;
    vec3 b = a + image.along;
    vec3 e = image.axes[2];
    meridian.latitudes = vec2(atan(dot(a, e), dot(a, meridian.towards)), atan(dot(b, e), dot(b, meridian.towards)));
    return meridian;
}

// The point at `along` of [0, 1] of a meridian; `width` is its share of longitude.
Point meridian_point(Proxy proxy, StripImage image, Meridian meridian, float along, float width) {
    float extent = meridian.latitudes.y - meridian.latitudes.x;
    float latitude = meridian.latitudes.x + along * extent;
    // A quarter turn rounded up has a cosine of −4e-8, which a narrow lobe makes −2e-4 of its light.
    float c = max(cos(latitude), 0.0);
    vec3 q = meridian.towards * c + image.axes[2] * sin(latitude);
    return point_of(proxy, q, width * abs(extent) * c);
}

#endif
