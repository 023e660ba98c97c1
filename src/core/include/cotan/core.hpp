// The core: frames, normal-map conventions, tangents. Needs GLM and nothing else.
//
//     using namespace cotan;
//     const Convention convention = *parseConvention("gltf");
//     const auto format = toFormat<f32::cotan_normal_format>(convention);
//     const f32::cotan_vec3 texel = f32::cotan_decode({0.5f, 0.5f, 1}, format);
//     const Covector3<float> n(0, 0, 1);
//     const Differences<float> d = {{1, 0, 0}, {0, 1, 0}, {1, 0}, {0, 1}};
//     const Covector3<float> normal = perturb(makeFrame(Frame::cotangent, n, d), texel);
//
// This header includes the whole core. The headers of its topics, in reading order, can also be included one by one.
#pragma once

// clang-format off: in the order in which one needs them
#include "cotan/convention.hpp" // how a normal map is stored
#include "cotan/covector.hpp"   // vectors and covectors as different types
#include "cotan/frame.hpp"      // frames by name
#include "cotan/gpu_meshes.hpp" // meshes for vertex, mesh and compute shaders
#include "cotan/portable.hpp"   // the text of the shaders as C++
#include "cotan/result.hpp"     // results of functions that can fail, and progress
#include "cotan/tangents.hpp"   // tangents and cotangents of a mesh
#include "cotan/triangle.hpp"   // the frame `triangle` from arrays
#include "cotan/vector.hpp"     // vectors that may be zero or not finite
#include "cotan/version.hpp"    // the version of the library
// clang-format on
