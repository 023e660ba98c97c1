// From the middle of a pixel to its samples, in pixels: the standard places of four.
const vec2 kSamplePlaces[4] =
    vec2[](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));
