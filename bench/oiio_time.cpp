// Times reading and writing images with plain OpenImageIO, and makes the images for that.
//   oiio_time make height|normal SIDE BITS FILE   a seamless relief with detail at every scale, or its normals
//   oiio_time copy IN LIKE OUT                    reads IN, writes the pixels of LIKE (read before) to OUT; prints
//                                                 wall-clock and processor seconds
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <sys/resource.h>

namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

struct PixelData {
    ImageSpec spec;
    std::vector<std::byte> data;
};

[[noreturn]] void fail(const std::string& what)
{
    std::fprintf(stderr, "oiio_time: %s\n", what.c_str());
    std::exit(3);
}

PixelData read(const std::string& file)
{
    auto in = ImageInput::open(file);
    if (!in)
        fail(OIIO::geterror());
    PixelData p{in->spec(), {}};
    p.data.resize(p.spec.image_bytes(true));
    if (!in->read_image(0, 0, 0, p.spec.nchannels, p.spec.format, p.data.data()))
        fail(in->geterror());
    return p;
}

void write(const std::string& file, const PixelData& p)
{
    auto out = ImageOutput::create(file);
    ImageSpec spec(p.spec.width, p.spec.height, p.spec.nchannels, p.spec.format); // with OpenImageIO's defaults
    if (!out || !out->open(file, spec) || !out->write_image(p.spec.format, p.data.data()) || !out->close())
        fail(out ? out->geterror() : OIIO::geterror());
}

// Smoothly interpolated noise on a grid of period `cells`, in [0,1].
double noise(double x, double y, int cells, std::uint32_t seed)
{
    const auto value = [&](int i, int j) {
        std::uint32_t h =
            std::uint32_t(i % cells) * 0x9e3779b1u ^ std::uint32_t(j % cells) * 0x85ebca77u ^ seed * 0xc2b2ae3du;
        h = (h ^ (h >> 15)) * 0x2c1b3c6du;
        h = (h ^ (h >> 12)) * 0x297a2d39u;
        return double((h ^ (h >> 15)) >> 8) / 16777216.0;
    };
    const double u = x * cells, v = y * cells;
    const int i = int(u), j = int(v);
    const double fx = u - i, fy = v - j, sx = fx * fx * (3 - 2 * fx), sy = fy * fy * (3 - 2 * fy);
    return (value(i, j) * (1 - sx) + value(i + 1, j) * sx) * (1 - sy)
        + (value(i, j + 1) * (1 - sx) + value(i + 1, j + 1) * sx) * sy;
}

void make(const std::string& kind, int side, int bits, const std::string& file)
{
    std::vector<float> height(std::size_t(side) * std::size_t(side));
    for (int octave = 0, cells = 8; cells <= side / 2; ++octave, cells *= 2)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                height[std::size_t(y) * std::size_t(side) + std::size_t(x)] +=
                    float(0.5 * std::pow(0.5, octave)
                          * noise((x + 0.5) / side, (y + 0.5) / side, cells, std::uint32_t(octave)));
    PixelData p{ImageSpec(side, side, kind == "normal" ? 3 : 1, bits == 8 ? TypeDesc::UINT8 : TypeDesc::UINT16), {}};
    p.data.resize(p.spec.image_bytes(true));
    const double maximum = bits == 8 ? 255 : 65535;
    std::size_t at = 0;
    const auto put = [&](double value) {
        const auto code = std::uint16_t(value * maximum + 0.5);
        std::memcpy(p.data.data() + at, &code, std::size_t(bits / 8)); // little-endian
        at += std::size_t(bits / 8);
    };
    const auto h = [&](int x, int y) {
        return double(height[std::size_t((y + side) % side) * std::size_t(side) + std::size_t((x + side) % side)]);
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            if (kind != "normal") {
                put(h(x, y));
                continue;
            }
            const double k = side / 40.0, dx = (h(x + 1, y) - h(x - 1, y)) * k, dy = (h(x, y - 1) - h(x, y + 1)) * k;
            const double length = std::sqrt(dx * dx + dy * dy + 1);
            for (double c : {-dx / length, -dy / length, 1 / length})
                put((c * 127 + 128) / 255);
        }
    write(file, p);
}

double processorSeconds()
{
    rusage u{};
    ::getrusage(RUSAGE_SELF, &u);
    return double(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + double(u.ru_utime.tv_usec + u.ru_stime.tv_usec) * 1e-6;
}

void copy(const std::string& in, const std::string& like, const std::string& out)
{
    const PixelData content = read(like);
    const auto start = std::chrono::steady_clock::now();
    const double before = processorSeconds();
    read(in);
    write(out, content);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    std::printf("%.2f %.2f\n", taken.count(), processorSeconds() - before);
}

} // namespace

int main(int count, char** words)
{
    const std::string mode = count > 1 ? words[1] : "";
    if (mode == "make" && count == 6)
        make(words[2], std::atoi(words[3]), std::atoi(words[4]), words[5]);
    else if (mode == "copy" && count == 5)
        copy(words[2], words[3], words[4]);
    else
        fail("expected make KIND SIDE BITS FILE, or copy IN LIKE OUT");
}
