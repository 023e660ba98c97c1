// The numbers that stand for types and modes in glTF, which has them from OpenGL.
#pragma once

namespace cotan::gltf {

inline constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                     kFloat = 5126;

inline constexpr int kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

// Targets of buffer views.
inline constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

inline constexpr int kNearest = 9728, kLinear = 9729, kNearestMipmapNearest = 9984, kLinearMipmapNearest = 9985,
                     kNearestMipmapLinear = 9986, kLinearMipmapLinear = 9987;

inline constexpr int kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648;

} // namespace cotan::gltf
