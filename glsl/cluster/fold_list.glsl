// A folded cluster's list, appended to by all invocations together: four indices a texel.

// Indices that wait for a texel's other ones: up to three, and those of a batch.
const uint WAITING = 4u + BATCH_LIGHTS;
shared uint waiting[WAITING];
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

// Writes all whole texels of what waits.
void flush_texels() {
    uint lane = gl_LocalInvocationIndex;
    barrier();
    uint full = waiting_count / 4u;
    flush(full);
    uint left = lane < 4u ? waiting[min(4u * full + lane, WAITING - 1u)] : 0u;
    barrier();
    if (lane < 4u) waiting[lane] = left;
    waiting_count &= 3u;
    barrier();
}

void end_list() {
    flush(end > texel ? end - texel : 0u);
}
