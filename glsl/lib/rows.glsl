// One long row of texels, broken into the rows of a texture.
#ifndef LIB_ROWS_GLSL
#define LIB_ROWS_GLSL

ivec2 in_rows(uint index, uint width_log2) {
    return ivec2(index & ((1u << width_log2) - 1u), index >> width_log2);
}

// Row `row` of a material's record.
ivec2 in_records(uint material, uint row) {
    return in_rows((material << MATERIAL_RECORD_LOG2) + row, MATERIALS_PER_ROW_LOG2 + MATERIAL_RECORD_LOG2);
}

#endif
