// Normals and frames from the GPU, against analytic results.
#include <algorithm>

#include "render_scene.hpp"

namespace cotan {

using namespace rendertest;

namespace {

struct Gradients {
    glm::dvec3 u;
    glm::dvec3 v;
    glm::dvec3 n; // the mesh's normal in world space
};

// Gradients for quad() with these uv under a matrix: the dual basis of dP/du, dP/dv.
Gradients gradientsOf(glm::dvec2 du, glm::dvec2 dv, const glm::mat4& toWorld)
{
    const glm::dmat3 m(toWorld);
    const glm::dvec3 px = m[0]; // dP/dx, dP/dy of the quad's own coordinates
    const glm::dvec3 py = m[1];
    // (u,v) = (x,y) * D, so (x,y) depends on u by the inverse of D.
    const double det = du.x * dv.y - du.y * dv.x;
    const glm::dvec3 pu = (px * dv.y - py * du.y) / det;
    const glm::dvec3 pv = (py * du.x - px * dv.x) / det;
    const glm::dvec3 face = glm::cross(pu, pv);
    Gradients g;
    g.u = glm::cross(pv, face) / glm::dot(face, face);
    g.v = glm::cross(face, pu) / glm::dot(face, face);
    g.n = glm::normalize(glm::inverseTranspose(m) * glm::dvec3(0, 0, 1));
    return g;
}

// A skewed, stretched and rotated placement that keeps the quad at the centre of the view.
glm::mat4 placement(bool mirrored)
{
    glm::mat4 m(1);
    m[0] = {mirrored ? -1.1f : 1.1f, 0.2f, 0.3f, 0};
    m[1] = {-0.1f, 0.9f, -0.4f, 0};
    m[2] = {0.1f, 0.2f, 1.0f, 0};
    return m;
}

bool everyFrameExists(Frame frame, Renderer& renderer)
{
    const Result<Image> image = renderer.draw(viewOf(Output::normal, frame));
    return bool(image);
}

// Calls check for each pixel with a surface, with its vector; returns the number of calls.
template<class Check> int overSurface(const Image& a, Check check)
{
    int count = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x)
            if (floatPixel(a, x, y).w > 0.5f) {
                check(x, y, glm::dvec3(floatPixel(a, x, y)));
                ++count;
            }
    return count;
}

} // namespace

// Two columns of texels, 10 steps of 8 bits apart, over the whole image. A step is 0.45 degrees: a driver that rounds
// filtered values to 8 bits errs by up to 0.23; the tolerance only allows for 8-bit weights, 0.02.
TEST(RenderFrame, magnified8BitMapsAreFilteredAboveTheirPrecision)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Image map = makeImage(2, 2, PixelType::unorm8);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t c = 0; c < 4; ++c)
            map.bytes8()[4 * i + c] = c >= 2 ? 255 : c == 0 && i % 2 == 1 ? 138 : 128;
    load(renderer, sceneOf(quad({0.25f, 0}, {0, -0.25f}), map)); // uv from one column's centre to the other's
    View view = viewOf(Output::normal);
    view.camera.eye = {0, 0, 0.5f};
    const Image image = drawn(renderer, view);
    double worst = 0;
    int seen = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const glm::vec3 n(floatPixel(image, x, y));
            const double half =
                0.5 * std::tan(0.5 * double(view.camera.verticalFieldOfView)); // visible half-width of the plane
            const double position = half * (2 * (x + 0.5) / view.width - 1);   // on the quad, -1 to 1
            const glm::dvec3 expected(10.0 / 127 * (0.5 + 0.5 * position), 0, 1);
            worst = std::max(worst, degreesBetween(n, glm::normalize(expected)));
            seen += n.z > 0 ? 1 : 0;
        }
    EXPECT_EQ(seen, view.width * view.height);
    EXPECT_LT(worst, 0.05);
}

TEST(RenderFrame, flatMapChangesNothingInAnyFrame)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Mesh mesh = sphere(12);
    mesh.tangents.assign(mesh.vertexCount(), {1, 0, 0, 1});
    mesh.cotangentsU.assign(mesh.vertexCount(), {1, 0, 0});
    mesh.cotangentsV.assign(mesh.vertexCount(), {0, 1, 0});
    load(renderer, sceneOf(mesh, flatImage(texelOf({0, 0, 1}))));
    View plain = viewOf(Output::normal);
    plain.normalMaps = false;
    const Image expected = drawn(renderer, plain);
    for (const FrameInfo& info : frames()) {
        if (!everyFrameExists(info.frame, renderer))
            continue;
        const Image image = drawn(renderer, viewOf(Output::normal, info.frame));
        const int count = overSurface(image, [&](int x, int y, glm::dvec3 n) {
            // Texel 128/255 in float is zero to 1e-7; that is 1e-5 degrees.
            EXPECT_LT(degreesBetween(n, glm::dvec3(floatPixel(expected, x, y))), 1e-4) << info.name;
        });
        EXPECT_GT(count, 500);
    }
}

TEST(RenderFrame, rowDirectionChangesOnlyTheFrameOf2013)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    load(renderer, sceneOf(sphere(16), flatImage(texelOf({0.4f, 0.3f, 1}))));
    for (const Frame frame : {Frame::cotangent, Frame::cotangent2013}) {
        View view = viewOf(Output::tangent, frame);
        const Image down = drawn(renderer, view);
        view.rowsUpward = true;
        const Image up = drawn(renderer, view);
        int count = 0;
        overSurface(down, [&](int x, int y, glm::dvec3 t) {
            const glm::dvec3 other(floatPixel(up, x, y));
            if (glm::length(t) < 0.1 || glm::length(other) < 0.1)
                return; // at the poles u has no direction
            const double angle = degreesBetween(t, other);
            // The height is even, so both rasters pair the same rows: equal up to rounding of pixel derivatives, 1e-6
            // of 1/32.
            EXPECT_LT(frame == Frame::cotangent ? angle : 180 - angle, 0.1);
            ++count;
        });
        EXPECT_GT(count, 500);
    }
}

TEST(RenderFrame, tangentsFollowTheGradientsInEverySignCombination)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    int combinations = 0;
    for (const bool mirrored : {false, true})
        for (const bool uvMirrored : {false, true})
            for (const bool normalReversed : {false, true}) {
                const glm::dvec2 du(uvMirrored ? -0.5 : 0.5, 0.1);
                const glm::dvec2 dv(0.2, -0.3);
                Mesh mesh = quad(glm::vec2(du), glm::vec2(dv));
                if (normalReversed)
                    for (glm::vec3& n : mesh.normals)
                        n = -n;
                Scene scene = sceneOf(mesh, flatImage(texelOf({0, 0, 1})), placement(mirrored));
                scene.materials[0].doubleSided = true;
                load(renderer, scene);
                const Gradients g = gradientsOf(du, dv, placement(mirrored));
                for (const bool fromBehind : {false, true})
                    for (const bool rowsUpward : {false, true}) {
                        View view = viewOf(Output::tangent);
                        view.camera.eye.z = fromBehind ? -3.0f : 3.0f;
                        view.rowsUpward = rowsUpward;
                        const glm::dvec3 t(floatPixel(drawn(renderer, view), 32, 32));
                        view.output = Output::bitangent;
                        const glm::dvec3 b(floatPixel(drawn(renderer, view), 32, 32));
                        // Float derivatives of a pixel 1/32 wide: 1e-3 degrees.
                        EXPECT_LT(degreesBetween(t, g.u), 0.02);
                        EXPECT_LT(degreesBetween(b, g.v), 0.02);
                        ++combinations;
                    }
            }
    EXPECT_EQ(combinations, 32);
}

TEST(RenderFrame, planeWithAKnownMapHasTheAnalyticNormals)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    constexpr int kSize = 4;
    Image map = makeImage(kSize, kSize, PixelType::float32);
    std::vector<glm::dvec3> stored; // along +u, along green, outwards
    for (int i = 0; i < kSize * kSize; ++i) {
        const glm::vec3 m(0.1f * float(i % 5) - 0.2f, 0.3f - 0.05f * float(i), 1);
        stored.push_back(glm::dvec3(m));
        const glm::vec4 texel = texelOf(m);
        for (int c = 0; c < 4; ++c)
            map.floats()[4 * i + c] = texel[c];
    }
    const glm::dvec2 du(0.9, 0.1); // stretched and skewed
    const glm::dvec2 dv(0.3, -0.45);
    for (const bool greenAlongV : {false, true}) {
        Scene scene = sceneOf(quad(glm::vec2(du), glm::vec2(dv)), map, placement(/*mirrored*/ false));
        scene.materials[0].normalFormat.greenUp = !greenAlongV;
        load(renderer, scene);
        const Gradients g = gradientsOf(du, dv, placement(/*mirrored*/ false));
        const double longest = std::max(glm::length(g.u), glm::length(g.v));
        for (const Frame frame : {Frame::cotangent, Frame::exact}) {
            if (!everyFrameExists(frame, renderer))
                continue;
            View view = viewOf(Output::uv, frame);
            view.pointSampled = true;
            const Image uv = drawn(renderer, view);
            view.output = Output::normal;
            const Image normals = drawn(renderer, view);
            int count = 0;
            overSurface(normals, [&](int x, int y, glm::dvec3 n) {
                glm::dvec2 at = glm::dvec2(floatPixel(uv, x, y)) * double(kSize);
                const glm::dvec2 inTexel = at - glm::floor(at);
                if (std::min({inTexel.x, inTexel.y, 1 - inTexel.x, 1 - inTexel.y}) < 1e-3)
                    return; // rounding decides which texel is read
                at = at - double(kSize) * glm::floor(at / double(kSize));
                const glm::dvec3 m = stored[std::size_t(int(at.y) * kSize + int(at.x))];
                const double green = greenAlongV ? 1 : -1;
                const glm::dvec3 expected = (g.u * m.x + g.v * (m.y * green)) / longest + g.n * m.z;
                EXPECT_LT(degreesBetween(n, expected), 0.02) << info(frame).name;
                ++count;
            });
            EXPECT_GT(count, 500);
        }
    }
}

TEST(RenderFrame, backOfAThinSheetShowsTheNegatedNormal)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Scene scene = sceneOf(quad(), flatImage(texelOf({0.5f, 0.2f, 1})));
    scene.materials[0].doubleSided = true;
    load(renderer, scene);
    View view = viewOf(Output::normal);
    const glm::dvec3 front(floatPixel(drawn(renderer, view), 32, 32));
    view.camera.eye.z = -3;
    const glm::dvec3 back(floatPixel(drawn(renderer, view), 32, 32));
    EXPECT_LT(degreesBetween(front, -back), 0.01);
    EXPECT_LT(degreesBetween(front, {0.5, 0.2, 1}), 0.02); // u right, green up
}

TEST(RenderFrame, mirroredInstanceShowsItsFrontAndHidesItsBack)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    for (const bool mirrored : {false, true})
        for (const bool rowsUpward : {false, true}) {
            load(renderer, sceneOf(quad(), std::nullopt, placement(mirrored)));
            View view = viewOf(Output::normal);
            view.rowsUpward = rowsUpward;
            EXPECT_EQ(floatPixel(drawn(renderer, view), 32, 32).w, 1.0f);
            view.camera.eye.z = -3;
            EXPECT_EQ(floatPixel(drawn(renderer, view), 32, 32).w, 0.0f);
        }
}

TEST(RenderFrame, uvWithoutAreaGiveThePlainNormal)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    Mesh constant = quad({0, 0}, {0, 0});
    Mesh missing = quad();
    missing.texcoords[0].clear();
    for (const Mesh& mesh : {constant, missing}) {
        load(renderer, sceneOf(mesh, flatImage(texelOf({0.6f, 0.3f, 1}))));
        for (const Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact, Frame::smooth,
                                  Frame::vertex, Frame::mikktspace}) {
            if (!everyFrameExists(frame, renderer))
                continue;
            const Image image = drawn(renderer, viewOf(Output::normal, frame));
            const glm::dvec3 n(floatPixel(image, 32, 32));
            EXPECT_LT(degreesBetween(n, {0, 0, 1}), 1e-4) << info(frame).name;
            const Image tangent = drawn(renderer, viewOf(Output::tangent, frame));
            EXPECT_EQ(glm::length(glm::vec3(floatPixel(tangent, 32, 32))), 0.0f) << info(frame).name;
        }
    }
}

// glTF: the bitangent is cross(n, t) * w and points along green. In quad() u runs right and v down, so the green of a
// glTF map points up, t = +x, and w = +1.
TEST(RenderFrame, storedTangentsAgreeWithTheUv)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    for (const bool uvMirrored : {false, true})
        for (const bool instanceMirrored : {false, true}) {
            const float right = uvMirrored ? -1.0f : 1.0f;
            Mesh mesh = quad({0.5f * right, 0});
            mesh.tangents.assign(mesh.vertexCount(), {right, 0, 0, right});
            mesh.cotangentsU.assign(mesh.vertexCount(), {0.5f * right, 0, 0});
            mesh.cotangentsV.assign(mesh.vertexCount(), {0, -0.5f, 0});
            glm::mat4 m(1);
            m[0][0] = instanceMirrored ? -1.0f : 1.0f;
            load(renderer, sceneOf(mesh, flatImage(texelOf({0.5f, 0.2f, 1})), m));
            const glm::dvec3 expected(0.5 * right * m[0][0], 0.2, 1);
            for (const Frame frame : {Frame::cotangent, Frame::smooth, Frame::vertex, Frame::mikktspace}) {
                const Image image = drawn(renderer, viewOf(Output::normal, frame));
                EXPECT_LT(degreesBetween(glm::dvec3(floatPixel(image, 32, 32)), expected), 0.02) << info(frame).name;
            }
        }
}

TEST(RenderFrame, precisionIsIndependentOfTheOrigin)
{
    COTAN_RENDERER_OR_SKIP(renderer);
    const View near = viewOf(Output::normal);
    load(renderer, sceneOf(quad(), flatImage(texelOf({0.5f, 0.2f, 1}))));
    const glm::dvec3 expected(floatPixel(drawn(renderer, near), 20, 40));
    View far = near;
    const glm::vec3 offset(1048576, -1048576, 524288); // exact in float, and so is eye - offset
    far.camera.eye += offset;
    far.camera.target += offset;
    glm::mat4 m(1);
    m[3] = glm::vec4(offset, 1);
    load(renderer, sceneOf(quad(), flatImage(texelOf({0.5f, 0.2f, 1})), m));
    EXPECT_LT(degreesBetween(glm::dvec3(floatPixel(drawn(renderer, far), 20, 40)), expected), 1e-3);
}

} // namespace cotan
