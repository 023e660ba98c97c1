// Translucent fragments of a band of image rows: a linked list for each pixel, newest first. A layer's name is its
// index plus 1, and 0 ends a list: Mesa's CPU driver (22.3) also runs loops for pixels outside the image, which read 0.
layout(set = 0, binding = 3, std430) buffer ListBlock {
    CotanLayerLists lists;
    uint newest[]; // for each pixel of the band, in row order: the name of its newest layer, or 0
};
layout(set = 0, binding = 4, std430) buffer LayerBlock { CotanLayer layers[]; };

// Whether the pixel has no list: Mesa's CPU driver (22.3) draws samples half a pixel outside the scissor rectangle.
bool outsideBand()
{
    uvec2 p = uvec2(gl_FragCoord.xy);
    return p.x >= lists.width || p.y < lists.top || p.y >= lists.bottom;
}

uint pixelInBand()
{
    uvec2 p = uvec2(gl_FragCoord.xy);
    return (p.y - lists.top) * lists.width + p.x;
}
