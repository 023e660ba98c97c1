// Perturbs a normal of a triangle with mirrored uv, without a stored tangent, with an installed Cotan.
#include <cstdio>

#include <cotan/convention.hpp>
#include <cotan/frame.hpp>

int main()
{
    using namespace cotan;

    // Two edges of a triangle in the plane z = 0; u runs against x.
    Differences<float> d;
    d.dpdx = Vector3f(2, 0, 0);
    d.dpdy = Vector3f(0, 2, 0);
    d.duvdx = {-1, 0};
    d.duvdy = {0, 1};
    const Covector3f n(0, 0, 1);

    // A texel of an 8-bit glTF normal map. It leans towards +u and up the image (against +v).
    const auto format = toFormat<f32::cotan_normal_format>(*conventionFromName("gltf"));
    const glm::vec3 m = f32::cotan_decode(glm::vec3(191, 191, 218) / 255.0f, format);

    const CotangentFrame<float> frame = makeFrame(Frame::cotangent, n, d);
    const Covector3f perturbed = perturb(frame, m);
    std::printf("t (%g %g %g)  b (%g %g %g)  n' (%.3f %.3f %.3f)\n", frame.t.x, frame.t.y, frame.t.z, frame.b.x,
                frame.b.y, frame.b.z, perturbed.x, perturbed.y, perturbed.z);
    // +u points along -x here, so the normal leans to -x; +v along +y, so it leans to -y.
    return perturbed.x < 0 && perturbed.y < 0 ? 0 : 1;
}
