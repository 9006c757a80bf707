// Set 0: the frame. Constants for every stage; images are declared by the shaders that use them.
#ifndef BIND_FRAME_GLSL
#define BIND_FRAME_GLSL

layout(set = SET_frame, binding = FRAME_CONSTANTS, std140) uniform FrameBlock { FrameConstants frame; };

#endif
