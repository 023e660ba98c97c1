// Animated GIF by OpenImageIO: one subimage a picture.
#include <array>
#include <cmath>
#include <exception>
#include <fstream>
#include <vector>

#include <fmt/format.h>

#include "oiio.hpp"

namespace cotan::oiio {

namespace {

// Where in a whole GIF the delays of its pictures are: two bytes each, in hundredths of a second, the low one first.
std::vector<std::streamoff> delaysOf(std::istream& gif)
{
    constexpr int kHead = 13, kImage = 9; // bytes: of the file, and of a picture behind its mark
    const auto skipTable = [&](int flags) { gif.ignore((flags & 0x80) != 0 ? 3 << ((flags & 7) + 1) : 0); };
    const auto skipBlocks = [&] {
        for (int size = gif.get(); size > 0; size = gif.get())
            gif.ignore(size);
    };
    std::vector<std::streamoff> delays;
    std::array<char, kHead> head{};
    gif.read(head.data(), kHead);
    skipTable(head[10]);
    for (int mark = gif.get(); mark == '!' || mark == ','; mark = gif.get()) {
        if (mark == '!') {
            if (gif.get() == 0xf9) // its block: size, flags, delay, transparent colour
                delays.push_back(std::streamoff(gif.tellg()) + 2);
        } else {
            gif.read(head.data(), kImage);
            skipTable(head[8]);
            gif.ignore(1); // bits of a code
        }
        skipBlocks();
    }
    return delays;
}

// OpenImageIO 2.5 gives every picture a second, whatever FramesPerSecond says.
bool setDelays(const std::filesystem::path& file, double rate)
{
    std::fstream gif(file, std::ios::in | std::ios::out | std::ios::binary);
    const std::vector<std::streamoff> delays = delaysOf(gif);
    gif.clear(); // that the end was reached
    const auto delay = unsigned(std::lround(100 / rate));
    for (const std::streamoff at : delays) {
        gif.seekp(at);
        gif.put(char(delay & 255)).put(char(delay >> 8));
    }
    gif.close();
    return bool(gif);
}

class Gif : public AnimationWriter {
public:
    Gif(std::filesystem::path file, const AnimationFormat& format, std::string name)
        : file_(std::move(file)), name_(std::move(name)), spec_(format.width, format.height, 4, OIIO::TypeDesc::UINT8),
          rate_(format.rate), left_(format.pictures), checked_(file_)
    {
        spec_.attribute("FramesPerSecond", float(format.rate));
    }

    Status add(const Image& picture) override
    {
        try {
            if (left_ == 0)
                return outputError(name_ + ": there are more pictures than were announced");
            if (!output_) {
                output_ = OIIO::ImageOutput::create("gif");
                const std::vector<OIIO::ImageSpec> all(left_, spec_);
                if (!output_ || !output_->set_ioproxy(&checked_)
                    || !output_->open(file_.string(), int(left_), all.data()))
                    return failed();
            } else if (!output_->open(file_.string(), spec_, OIIO::ImageOutput::AppendSubimage)) {
                return failed();
            }
            --left_;
            return output_->write_image(OIIO::TypeDesc::UINT8, picture.data.data()) ? Status(Done{}) : failed();
        } catch (const std::exception& e) {
            return outputError(fmt::format("{}: {}", name_, oneLine(e.what())));
        }
    }

    Status finish() override
    {
        const bool closed = output_ && output_->close();
        if (Status whole = checked_.finish(name_); !whole)
            return whole;
        if (!closed)
            return failed();
        return setDelays(file_, rate_) ? Status(Done{}) : outputError(name_ + ": cannot write the file");
    }

private:
    Status failed() const
    {
        return outputError(fmt::format("{}: {}", name_, oneLine(output_ ? output_->geterror() : OIIO::geterror())));
    }

    std::filesystem::path file_;
    std::string name_;
    OIIO::ImageSpec spec_;
    double rate_; // pictures a second
    std::size_t left_;
    CheckedFile checked_;
    std::unique_ptr<OIIO::ImageOutput> output_; // writes to it until it ends
};

} // namespace

Result<std::unique_ptr<AnimationWriter>> createGif(const std::filesystem::path& file, const AnimationFormat& format,
                                                   const std::string& name)
{
    return std::unique_ptr<AnimationWriter>(new Gif(file, format, name));
}

} // namespace cotan::oiio
