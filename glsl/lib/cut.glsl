// When a node stands for its lights. Exact to the last bit wherever it is compiled: the count of a cut and the cut itself
// come from two pipelines.
#ifndef LIB_CUT_GLSL
#define LIB_CUT_GLSL

// A node's error at squared distance d2, in W·sr⁻¹·m⁻²: its irradiance times its relative error.
float node_error(float power, float radius, float error, float d2) {
    precise float inverse = inversesqrt(d2);
    precise float x = radius * inverse;
    precise float relative = error * (x * x * x);
    precise float off = relative * (power * inverse * inverse);
    return off;
}

// Whether all of a node is far enough, and its error within the limit. False where the distance is 0.
bool node_fits(float radius, float d2, float error, float open2, float limit) {
    precise float least = open2 * radius * radius;
    return d2 > least && error <= limit;
}

#endif
