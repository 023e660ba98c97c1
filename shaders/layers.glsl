// Translucent fragments of a band of the picture's rows: a list for each pixel, in the order of arrival.
// Layers are named by their index plus 1, so that 0 ends a list: Mesa's CPU driver (22.3) runs loops for
// pixels beside the picture too, and what these read is 0.
layout(set = 0, binding = 3, std430) buffer ListBlock {
    CotanLayerLists lists;
    uint newest[]; // of each pixel of the band, rows first: the name of a layer, or 0
};
layout(set = 0, binding = 4, std430) buffer LayerBlock { CotanLayer layers[]; };

// Mesa's CPU driver (22.3) draws samples half a pixel beside the scissor's rectangle: pixels without a list.
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
