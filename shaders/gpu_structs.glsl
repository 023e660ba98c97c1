// Data that the CPU passes to the shaders, as text that is both GLSL and C++: src/render/vulkan/gpu_structs.hpp
// declares vec4, uvec2, ivec4 and uvec4 and includes this file. Every member is 16-byte aligned or part of a group of
// 16 bytes, so that std140, std430 and C++ agree. A test compares the offsets in the compiled shaders with those of
// C++.

// A use of an image. It maps (u,v) to (dot(uRow.xy, uv) + uRow.z, dot(vRow.xy, uv) + vRow.z).
struct CotanTextureUse {
    vec4 uRow; // w: uv set, 0 or 1
    vec4 vRow; // w: 1 if there is an image, otherwise 0
};

// Uniform buffer, one per material.
struct CotanMaterial {
    vec4 baseColor;    // linear, alpha
    vec4 emissive;     // linear; w: alpha cutoff
    vec4 factors;      // metallic, roughness, occlusion strength, normal scale
    ivec4 normalMap;   // expansion, channels, green (+1 along v, -1 against it), 1 if unlit
    vec4 coat;         // strength, roughness, normal scale; w: transmission
    ivec4 coatNormalMap; // as normalMap; w: 1 if it shares the normal map's uv
    vec4 anisotropy;   // strength, direction along +u and +v; w: index of refraction
    vec4 specular;     // linear colour of a dielectric's reflection; w: strength
    vec4 sheen;        // linear; w: roughness
    vec4 heights;      // depth, fewest and most steps of a ray, halvings of the last
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
    CotanTextureUse heightMapUse;
};

// A bit for each map, in the order above, which is also that of the bindings from 1. Materials without extensions have
// only the first five, because CPU drivers spend time on every descriptor, used or not.
#define COTAN_MAP_COUNT 15
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
#define COTAN_MAP_HEIGHT 16384u
#define COTAN_MAP_OCCLUSION_SHARED 65536u // occlusion is in r of the metallic-roughness texel
// Layers of the material besides metallic-roughness.
#define COTAN_LAYER_COAT 131072u
#define COTAN_LAYER_GLOSS 262144u // specular, index of refraction, or one of the next two
#define COTAN_LAYER_ANISOTROPY 524288u
#define COTAN_LAYER_TRANSMISSION 1048576u
#define COTAN_LAYER_SHEEN 2097152u
// All bits that materials without extensions may have.
#define COTAN_MAPS_PLAIN (31u | COTAN_MAP_OCCLUSION_SHARED)

// Storage buffer, an array.
struct CotanLight {
    vec4 position;  // relative to the eye, world axes; w: 0 directional, 1 point, 2 spot
    vec4 direction; // unit, along the light's travel; w: range in metres, 0 infinite
    vec4 color;     // linear, times intensity; w: 1 if this light casts the shadow
    vec4 cone;      // cosines of the outer and the inner half angle, inner > outer
};

// Uniform buffer, one per image. "Camera-relative" is world space translated so that the eye is at the origin.
struct CotanView {
    vec4 clipX;   // rows of the matrix from camera-relative position to clip space
    vec4 clipY;
    vec4 clipZ;
    vec4 clipW;
    vec4 right;   // at distance 1: half the image width, to its right; w unused
    vec4 up;      // at distance 1: half the image height, along increasing clip y; w unused
    vec4 forward; // unit; w: 1 perspective, 0 orthographic (right and up are then 0)
    vec4 shadowX; // rows: camera-relative position to shadow map u, v in [0,1] and depth in [0,1]
    vec4 shadowY;
    vec4 shadowZ;
    vec4 shadow;  // texel size in world units, texels a side, half a texel as depth; w unused
    vec4 soft;    // x: half penumbra width in map u per map depth; y: its maximum; z: world length of u / of depth
    vec4 ground;  // camera-relative x and z to uv of the ground map: scale and offset of x, then of z
    vec4 tone;    // x: exposure; y: roughness of the backdrop's blur; z: camera-relative height of the ground
    uvec4 counts; // x: lights; y: 1 if levels are dithered; z: image height if its rows run upward, otherwise 0
};

// Push constants, one block per instance: exactly the 128 bytes that every device supports.
struct CotanDraw {
    vec4 rowX;       // rows of the matrix from mesh to camera-relative position
    vec4 rowY;
    vec4 rowZ;
    vec4 normalX;    // rows of its inverse transpose, up to a positive factor
    vec4 normalY;
    vec4 normalZ;    // w of normalX: sign of the determinant
    uvec2 positions; // address of the mesh's positions, three floats per vertex
    uvec2 texcoords; // offsets of uv sets 0 and 1 from `positions`, in floats; two floats per vertex
    uvec2 indices;   // address of the mesh's indices
    uint flags;      // COTAN_DRAW_...; from bit COTAN_DRAW_FRAME_BIT on: the mesh's frame, for COTAN_FRAME_OF_MESH
    uint order;      // index of a translucent instance in drawing order
};

// A value of COTAN_FRAME: each mesh is drawn with a frame of its own, one of the four that are chosen by measurement.
#define COTAN_FRAME_OF_MESH 255u
#define COTAN_DRAW_FRAME_BIT 8u
#define COTAN_DRAW_HAS_TANGENTS 1u
#define COTAN_DRAW_HAS_COTANGENTS 2u
#define COTAN_DRAW_HAS_TEXCOORDS0 4u
#define COTAN_DRAW_HAS_TEXCOORDS1 8u

// Storage buffer: header of the lists of translucent fragments.
struct CotanLayerLists {
    uint count;    // of requested layers; those beyond the capacity are not stored
    uint capacity;
    uint width;    // of the image, in pixels
    uint top;      // first row of the band in the raster
    uint bottom;   // row after the last one
};

// Storage buffer, an array: one translucent fragment.
struct CotanLayer {
    vec4 light;            // premultiplied linear colour; w: depth at the pixel's centre, 1 near, 0 far
    vec4 transmittance;    // w: difference of depth to the next pixel in x
    float depthY;
    uint orderAndCoverage; // CotanDraw::order times 16, plus a bit for each covered sample
    uint triangle;         // index in the mesh if the device provides it, otherwise 0
    uint previous;         // name (index + 1) of the previous layer of the same pixel, or 0
};
