// Translucent fragments of a band of the picture's rows: a list for each pixel, in the order of arrival.
#define COTAN_NO_LAYER 0xffffffffu

layout(set = 0, binding = 3, std430) buffer ListBlock {
    CotanLayerLists lists;
    uint newest[]; // of each pixel of the band, rows first: an index into layers, or COTAN_NO_LAYER
};
layout(set = 0, binding = 4, std430) buffer LayerBlock { CotanLayer layers[]; };

uint pixelInBand()
{
    uvec2 p = uvec2(gl_FragCoord.xy);
    return (p.y - lists.top) * lists.width + p.x;
}
