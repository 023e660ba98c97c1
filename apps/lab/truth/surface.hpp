// Analytic curved surfaces: positions, gradients of uv, normals, and the normals of a relief on them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "truth/jet.hpp"
#include "truth/patch.hpp"
#include "truth/relief.hpp"

namespace cotan {

// The differential geometry of a surface point. Suffixes s and t denote derivatives by the parameters.
struct SurfacePoint {
    glm::dvec2 parameters, uv;
    glm::dvec3 position, normal; // unit, outwards
    glm::dvec3 gradU, gradV;     // gradients of u and v, in the tangent plane
    glm::dvec3 dpdu, dpdv;       // tangents, dual to the gradients
    glm::dvec3 ps, pt, ns, nt;
};

// A surface over parameters (s,t) in the unit square; uv is a linear function of them.
struct Surface {
    std::string name;
    glm::dmat2 uvOfParameters; // uv = M (s,t)
    bool inward = false;       // ps x pt points inwards
    std::function<JetVector(Jet, Jet)> position;

    glm::dvec2 uv(glm::dvec2 parameters) const { return uvOfParameters * parameters; }
    glm::dvec2 parameters(glm::dvec2 uv) const;
    SurfacePoint at(glm::dvec2 parameters) const;

    // Truth E: the exact unit normal of the surface displaced along its normal by the relief, heights multiplied by
    // `scale`.
    glm::dvec3 displacedNormal(const SurfacePoint& p, const ReliefSample& relief, double scale) const;

    // World units per uv unit: the mean over the surface of 1 over the longer gradient. Makes reliefs of metric height
    // comparable with those of truth S.
    double unitsPerUv() const;
};

// sphere: longitude and latitude, up to latitudes of 75 degrees; mercator: a sphere with conformal uv; torus: radii 1
// and 0.4; spout: bent and tapering like a teapot's, uv sheared and stretched.
const std::vector<Surface>& surfaces();

// A flat patch in the plane z = 0, facing +z: position = [a b; c d] uv.
Surface patchSurface(const Layout& layout);

// Truth S on a curved surface: normalize(n - s (hu gradU + hv gradV)), s = 1 over the longer gradient, for a texel
// proportional to (-hu, -hv, 1).
glm::dvec3 truthS(const SurfacePoint& p, glm::dvec3 texel);

} // namespace cotan
