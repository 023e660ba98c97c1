// Offsets of the four standard sample positions from the pixel's centre, in pixels.
const vec2 kSampleOffsets[4] =
    vec2[](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));
