// What is written of a linear colour that is multiplied by its alpha, in the pixel of the fragment: where LEVELS, the
// levels of a picture with 8 bits.
vec4 written(vec4 color)
{
    if (!LEVELS)
        return color;
    uvec2 at = uvec2(gl_FragCoord.xy);
    if (view.counts.z != 0u) // the rows of the raster run upward
        at.y = view.counts.z - 1u - at.y;
    return cotan_levels_of_pixel(color, at.x, at.y, view.counts.y != 0u) / 255.0;
}
