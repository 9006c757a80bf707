// A cluster's list, appended to by all invocations together: four indices a texel. LANES as for lane_sums.

// Indices that wait for a texel's other ones: up to three, and those of a group for each invocation.
shared uint waiting[4u + LANES * LEAF_LIGHTS];
uint waiting_count = 0u;
uint texel;
uint end;

void begin_list(uint first, uint texels) {
    texel = first;
    end = first + texels;
}

uint waiting_at(uint i) { return i < waiting_count ? waiting[i] : frame.light_count; }

// Writes `count` texels of what waits, and null lights past its end.
void flush(uint count) {
    for (uint i = gl_LocalInvocationIndex; i < count; i += LANES) {
        uvec4 four = uvec4(waiting_at(4u * i), waiting_at(4u * i + 1u), waiting_at(4u * i + 2u), waiting_at(4u * i + 3u));
        if (texel + i < end) imageStore(light_lists, list_texel(texel + i), four);
    }
    texel += count;
}

// `sums`: of how many lights lower invocations list, and all.
void append(uint group, uint listed, uvec4 sums, uint room) {
    uint lane = gl_LocalInvocationIndex;
    for (uint at = waiting_count + sums.x; listed != 0u; listed &= listed - 1u) {
        waiting[at++] = light_of(group, uint(findLSB(listed)));
    }
    barrier();
    waiting_count += min(sums.z, room);
    uint full = waiting_count / 4u;
    flush(full);
    uint left = lane < 4u ? waiting[4u * full + lane] : 0u;
    barrier();
    if (lane < 4u) waiting[lane] = left;
    waiting_count &= 3u;
    barrier();
}

void end_list() {
    flush(end > texel ? end - texel : 0u);
}
