// What the module's two ways of reading and writing share.
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>

#include <OpenImageIO/imageio.h>

#include "cotan/image.hpp"
#include "cotan/result.hpp"
#include "cotan/scene.hpp"
#include "file_layout.hpp"
#include "image/format_table.hpp"

namespace cotan::oiio {

// Without trailing spaces and line breaks.
std::string oneLine(std::string text);

// OpenImageIO's name of the format of something that knownImage() accepted. The contents decide,
// as extensions are often wrong.
std::string formatOf(std::span<const std::byte> bytes);

PixelType pixelType(OIIO::TypeDesc format);
OIIO::TypeDesc typeDesc(PixelType type);

// Spreads the first `channels` components of every pixel over red, green, blue and alpha.
void completeChannels(Image& image, int channels);

// Compares what the headers of TIFF, OpenEXR, DDS and BMP files promise with the size of the file: every
// strip, tile, attribute and level that will be read, and blocks of OpenEXR with the limits. Their readers take memory
// by those numbers, or hand out what it held. format: of formatOf().
std::optional<Error> checkFileLayout(File& file, const std::string& name, const std::string& format,
                                     const LoadLimits& limits);

// Rows of a file without tiles, from `first` on: those of `to`, the first `channels` components of each pixel. False:
// input says why.
bool readScanlines(OIIO::ImageInput& input, int first, int channels, Image& to);

// What a header may claim beside its size.
std::optional<Error> checkLayers(const OIIO::ImageSpec& spec, const std::string& name);

// How values are to be read: as they are stored.
OIIO::ImageSpec readConfig();

// How components of `type` are stored.
OIIO::TypeDesc typeToWrite(const ImageFormat& format, PixelType type);

// channels: no more than the format has. frame: Image::frame, for the formats that hold it.
OIIO::ImageSpec outputSpec(int width, int height, int channels, OIIO::TypeDesc type, const ImageFormat& format,
                           const std::string& frame);

// The library's words within a sentence of ours: of a file that was read, and of one to be written.
Error brokenToOiio(const std::string& name, const std::string& format, const std::string& words);
inline Error notWritten(const std::string& name, const std::string& words)
{
    return outputError(name + ": expected to write the picture, OpenImageIO found: " + oneLine(words));
}

// A file that OpenImageIO writes to, and that knows whether all of it arrived. The writers of OpenImageIO do not: on a
// full disk that of Targa says that it is done, and that of JPEG ends the process.
class CheckedFile final : public OIIO::Filesystem::IOProxy {
public:
    // Replaces the file. Whether it could be made, finish() says, too.
    explicit CheckedFile(const std::filesystem::path& file)
        : IOProxy(file.string(), Write), file_(std::fopen(file.c_str(), "w+be")), error_(file_ ? 0 : errno)
    {
    }

    // Closes the file. Errors: ErrorKind::output with the system's reason where a byte is missing. name: for the
    // message.
    Status finish(const std::string& name)
    {
        if (file_ && std::fclose(file_.release()) != 0)
            note();
        return error_ == 0 ? Status(Done{}) : notWritten(name, std::generic_category().message(error_));
    }

    const char* proxytype() const override { return "checked"; } // with another than "file", JPEG is coded in memory

    std::size_t read(void* to, std::size_t count) override
    {
        const std::size_t done = pread(to, count, m_pos);
        m_pos += std::int64_t(done);
        return done;
    }

    std::size_t write(const void* from, std::size_t count) override
    {
        const std::size_t done = pwrite(from, count, m_pos);
        m_pos += std::int64_t(done);
        return done;
    }

    std::size_t pread(void* to, std::size_t count, std::int64_t offset) override
    {
        return moveTo(offset, Use::reading) ? std::fread(to, 1, count, file_.get()) : 0;
    }

    std::size_t pwrite(const void* from, std::size_t count, std::int64_t offset) override
    {
        if (!moveTo(offset, Use::writing))
            return 0;
        const std::size_t done = std::fwrite(from, 1, count, file_.get());
        at_ += std::int64_t(done);
        if (done != count)
            note();
        return done;
    }

    std::size_t size() const override
    {
        if (!file_ || ::fseeko(file_.get(), 0, SEEK_END) != 0)
            return 0;
        at_ = -1; // the next use looks for its place
        return std::size_t(::ftello(file_.get()));
    }

    void flush() const override
    {
        if (file_ && std::fflush(file_.get()) != 0)
            note();
    }

private:
    enum class Use { nothing, reading, writing };
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void note() const
    {
        if (error_ == 0)
            error_ = errno != 0 ? errno : EIO;
    }

    // A FILE wants a seek between reading and writing. Without one that is not needed its buffer is kept, and pipes,
    // which have no places, can be written to.
    bool moveTo(std::int64_t offset, Use use)
    {
        if (!file_)
            return false;
        if ((use != use_ && use_ != Use::nothing) || offset != at_ || use == Use::reading)
            if (::fseeko(file_.get(), offset, SEEK_SET) != 0) {
                note();
                return false;
            }
        use_ = use;
        at_ = use == Use::writing ? offset : -1;
        return true;
    }

    std::unique_ptr<std::FILE, Close> file_;
    mutable int error_; // the errno of the first failure
    Use use_ = Use::nothing;
    mutable std::int64_t at_ = 0; // where the next byte would be written; -1: not known
};

// Image::frame of a file.
std::string frameOf(const OIIO::ImageSpec& spec, const std::string& format);

// ImageFormats::openRows and createRows.
Result<std::unique_ptr<RowReader>> openRows(const std::filesystem::path& file, std::span<const std::byte> head,
                                            const LoadLimits& limits);
Result<std::unique_ptr<RowWriter>> createRows(const std::filesystem::path& file, const RowFormat& format, int threads,
                                              const std::string& name);

// ImageFormats::createGif.
Result<std::unique_ptr<AnimationWriter>> createGif(const std::filesystem::path& file, const AnimationFormat& format,
                                                   const std::string& name);

} // namespace cotan::oiio
