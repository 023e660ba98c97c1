// The value to write for a premultiplied linear colour in the fragment's pixel: if LEVELS, quantised to 8-bit levels.
vec4 quantised(vec4 color)
{
    if (!LEVELS)
        return color;
    uvec2 at = uvec2(gl_FragCoord.xy);
    if (view.counts.z != 0u) // the raster's rows run upward
        at.y = view.counts.z - 1u - at.y;
    return cotan_levels_of_pixel(color, at.x, at.y, view.counts.y != 0u) / 255.0;
}
