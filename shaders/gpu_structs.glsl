// What the CPU hands to the shaders. One text, valid GLSL and C++: the C++ side
// (src/render/vulkan/gpu_structs.hpp) names vec4, uvec2, ivec4 and uvec4 and includes this file.
// Every member starts on 16 bytes or fills a group of 16, so std140, std430 and C++ agree; a test
// compares the offsets in the compiled shaders with C++.

// A use of an image: (u,v) becomes (dot(uRow.xy, uv) + uRow.z, dot(vRow.xy, uv) + vRow.z).
struct CotanTextureUse {
    vec4 uRow; // w: which uv set, 0 or 1
    vec4 vRow; // w: 1 where there is an image, otherwise 0
};

// Uniform buffer, one a material.
struct CotanMaterial {
    vec4 baseColor;    // linear, alpha
    vec4 emissive;     // linear; w: alpha cutoff
    vec4 factors;      // metallic, roughness, occlusion strength, normal scale
    ivec4 normalMap;   // expansion, channels, green (+1 along v, -1 against it), 1 if unlit
    vec4 coat;         // strength, roughness, normal scale; w: transmission
    ivec4 coatNormalMap; // as normalMap; w: 1 if its uv are those of the normal map
    vec4 anisotropy;   // strength, direction along +u and +v; w: index of refraction
    vec4 specular;     // linear colour of a dielectric's reflection; w: strength
    vec4 sheen;        // linear; w: roughness
    CotanTextureUse baseColorMap;
    CotanTextureUse metallicRoughnessMap;
    CotanTextureUse normalMapUse;
    CotanTextureUse occlusionMap;
    CotanTextureUse emissiveMap;
    CotanTextureUse coatMap;
    CotanTextureUse coatRoughnessMap;
    CotanTextureUse coatNormalMapUse;
    CotanTextureUse anisotropyMap;
    CotanTextureUse specularMap;
    CotanTextureUse specularColorMap;
    CotanTextureUse sheenColorMap;
    CotanTextureUse sheenRoughnessMap;
    CotanTextureUse transmissionMap;
};

// A bit for each map, in the order above, which is that of the bindings from 1 on. Materials without extensions have
// the first five only: drivers for the CPU take time for every descriptor, used or not.
#define COTAN_MAP_COUNT 14
#define COTAN_MAP_COUNT_PLAIN 5
#define COTAN_MAP_BASE_COLOR 1u
#define COTAN_MAP_METALLIC_ROUGHNESS 2u
#define COTAN_MAP_NORMAL 4u
#define COTAN_MAP_OCCLUSION 8u
#define COTAN_MAP_EMISSIVE 16u
#define COTAN_MAP_COAT 32u
#define COTAN_MAP_COAT_ROUGHNESS 64u
#define COTAN_MAP_COAT_NORMAL 128u
#define COTAN_MAP_ANISOTROPY 256u
#define COTAN_MAP_SPECULAR 512u
#define COTAN_MAP_SPECULAR_COLOR 1024u
#define COTAN_MAP_SHEEN_COLOR 2048u
#define COTAN_MAP_SHEEN_ROUGHNESS 4096u
#define COTAN_MAP_TRANSMISSION 8192u
#define COTAN_MAP_OCCLUSION_SHARED 65536u // occlusion is in r of the metallic-roughness texel
// What the material has besides metallic-roughness.
#define COTAN_LAYER_COAT 131072u
#define COTAN_LAYER_GLOSS 262144u // reflections of its own: one of the next two, specular, index of refraction
#define COTAN_LAYER_ANISOTROPY 524288u
#define COTAN_LAYER_TRANSMISSION 1048576u
#define COTAN_LAYER_SHEEN 2097152u
// What materials without extensions have of all this.
#define COTAN_MAPS_PLAIN (31u | COTAN_MAP_OCCLUSION_SHARED)

// Storage buffer, an array.
struct CotanLight {
    vec4 position;  // relative to the eye, world axes; w: 0 directional, 1 point, 2 spot
    vec4 direction; // unit, the way the light travels; w: range in metres, 0 infinite
    vec4 color;     // linear, times intensity; w: 1 if this light casts the shadow
    vec4 cone;      // cosines of the outer and the inner half angle, inner > outer
};

// Uniform buffer, one a picture. "Camera-relative" is world space moved so that the eye is 0.
struct CotanView {
    vec4 clipX;   // rows of the matrix from camera-relative position to clip space
    vec4 clipY;
    vec4 clipZ;
    vec4 clipW;
    vec4 right;   // at distance 1: half the picture's width along its right; w unused
    vec4 up;      // at distance 1: half the height, along increasing clip y; w unused
    vec4 forward; // unit; w: 1 perspective, 0 orthographic (right and up are then 0)
    vec4 shadowX; // rows: camera-relative position to shadow map u, v in [0,1] and depth in [0,1]
    vec4 shadowY;
    vec4 shadowZ;
    vec4 shadow;  // size of a texel in world units, texels a side, half a texel as depth; w unused
    vec4 soft;    // x: widening of a half-shadow as map u a map depth; y: most u; z: map u a depth, lengths; w unused
    vec4 ground;  // camera-relative x and z to places in the ground's picture: scale, offset of x; of z
    vec4 tone;    // x: exposure; y: roughness of the mirror that the backdrop is seen in; z: camera-relative ground
    uvec4 counts; // x: lights; y: 1 if levels are dithered; z: rows of the picture where they run upward, otherwise 0
};

// Push constants, one an instance: exactly the 128 bytes that every device has.
struct CotanDraw {
    vec4 rowX;       // rows of the matrix from mesh to camera-relative position
    vec4 rowY;
    vec4 rowZ;
    vec4 normalX;    // rows of its inverse transpose up to a positive factor
    vec4 normalY;
    vec4 normalZ;    // w of normalX: sign of the determinant
    uvec2 positions; // address of the mesh's positions, three floats a vertex
    uvec2 texcoords; // where uv sets 0 and 1 start, in floats from there on: two floats a vertex
    uvec2 indices;   // address of the mesh's indices
    uint flags;      // COTAN_DRAW_...
    uint order;      // number of a translucent instance in the scene
};

#define COTAN_DRAW_HAS_TANGENTS 1u
#define COTAN_DRAW_HAS_COTANGENTS 2u
#define COTAN_DRAW_HAS_TEXCOORDS0 4u
#define COTAN_DRAW_HAS_TEXCOORDS1 8u

// Storage buffer: what the lists of translucent fragments start with.
struct CotanLayerLists {
    uint count;    // of layers that were asked for: beyond the capacity they are not there
    uint capacity;
    uint width;    // of the picture, in pixels
    uint top;      // row of the raster at which the band starts
    uint bottom;   // row below its last one
};

// Storage buffer, an array: one translucent fragment.
struct CotanLayer {
    vec4 light;    // linear colour times what it covers; w: depth in the middle of the pixel, 1 near, 0 far
    vec4 through;  // factors of what is behind; w: step of the depth to the next pixel in x
    float depthY;
    uint place;    // CotanDraw::order times 16, and a bit for each sample that is covered
    uint triangle; // of the mesh, where the device tells it, otherwise 0
    uint before;   // name (index + 1) of the layer of the same pixel that arrived before, or 0
};
