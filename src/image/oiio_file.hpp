// A file that OpenImageIO writes to, and that knows whether all of it arrived. The writers of OpenImageIO do not: on a
// full disk that of Targa says that it is done, and that of JPEG ends the process.
#pragma once

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <OpenImageIO/filesystem.h>

#include "oiio.hpp"

namespace cotan::oiio {

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

} // namespace cotan::oiio
