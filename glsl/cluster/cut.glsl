// The cut of the tree over lights without a range that serves a cluster. Errors of nodes are of either sign and add up in
// quadrature: worst-case bounds are 250 times too pessimistic to steer by, so each node may have the same share of the
// cluster's light, and the constants are calibrated (src/frame/cut.rs).
//
// The including shader defines ON_NODE(index, error), ON_ROOT(index) and ON_LEAF(first): a node that fits, and its error;
// one smaller than the cluster that does not, so that each pixel opens it for itself; a leaf that does not, by its first
// light. Each invocation walks alone and in the tree's order, so no subgroup size is assumed.
//
// A walk meets a few thousand nodes, because none smaller than the cluster is opened; one that meets more than MAX_VISITS,
// among lights strewn so that this does not hold, is given up for the whole tree as a root: lavapipe ends an invocation's
// loops after 65,535 iterations in all, and lights would be lost.
const uint MAX_VISITS = 32768u;

layout(local_size_x = LINEAR_GROUP) in;

uint cluster_here() {
    uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    return group * LINEAR_GROUP + gl_LocalInvocationIndex;
}

float box_distance2(vec3 lower, vec3 upper, vec3 place) {
    precise vec3 to_box = max(max(lower - place, place - upper), vec3(0.0));
    precise float d2 = to_box.x * to_box.x + to_box.y * to_box.y + to_box.z * to_box.z;
    return d2;
}

// Squared radius of a box.
float box_radius2(vec3 lower, vec3 upper) {
    precise vec3 d = 0.5 * (upper - lower);
    precise float r2 = d.x * d.x + d.y * d.y + d.z * d.z;
    return r2;
}

bool is_leaf(uint index, MomentHead node) { return node.skip == index + 1u; }

// Σ power/d² of all lights at the cluster, to some 10 %: nodes from one radius on as points, what is nearer spread out.
float light_at(vec3 lower, vec3 upper, inout uint visits) {
    vec3 middle = 0.5 * (lower + upper);
    float size2 = box_radius2(lower, upper);
    float sum = 0.0;
    uint index = 0u;
    // A walk that is given up has found less light than there is: the cut then is finer than it has to be.
    while (index < frame.moment_nodes && visits < MAX_VISITS / 2u) {
        MomentHead node = moment_head(index);
        float r2 = node.radius * node.radius;
        float d2 = box_distance2(lower, upper, node.center);
        bool far = d2 > r2;
        vec3 offset = node.center - middle;
        float spread = dot(offset, offset) + size2 + r2;
        bool stop = far || r2 < size2 || is_leaf(index, node);
        sum += stop ? node.power / max(far ? d2 : spread, TINY) : 0.0;
        index = stop ? node.skip : index + 1u;
        ++visits;
    }
    return sum;
}

// Whether the walk came to its end.
bool cut(vec3 lower, vec3 upper, float limit, inout uint visits) {
    float size2 = box_radius2(lower, upper);
    uint index = 0u;
    while (index < frame.moment_nodes && visits < MAX_VISITS) {
        MomentHead node = moment_head(index);
        float d2 = box_distance2(lower, upper, node.center);
        float error = node_error(node.power, node.radius, node.error, d2);
        bool dark = node.power == 0.0;
        bool fits = dark || node_fits(node.radius, d2, error, frame.cut_open2, limit);
        bool leaf = !fits && is_leaf(index, node);
        bool root = !fits && !leaf && node.radius * node.radius < size2;
        if (fits && !dark) {
            ON_NODE(index, error)
        }
        if (leaf) {
            ON_LEAF(node.first)
        }
        if (root) {
            ON_ROOT(index)
        }
        index = fits || leaf || root ? node.skip : index + 1u;
        ++visits;
    }
    return index >= frame.moment_nodes;
}
