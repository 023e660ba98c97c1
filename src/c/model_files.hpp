// Conversion of the caller's file functions and images, and of reports on models to text.
#pragma once

#include <cstring>
#include <span>
#include <utility>

#include "call.hpp"
#include "cotan/files.hpp"
#include "cotan/frame_choice.hpp"
#include "cotan/image.hpp"
#include "files/json.hpp"
#include "image_views.hpp"

namespace cotan::c {

using Bytes = std::vector<std::byte>;

inline Bytes copied(const void* bytes, std::size_t size)
{
    const auto* first = static_cast<const std::byte*>(bytes);
    return size > 0 ? Bytes(first, first + size) : Bytes();
}

// The file functions of the caller, as the library takes them.
class ModelFiles {
public:
    ModelFiles(const void* model, std::size_t size, const cotan_model_files* given)
        : model_(model), size_(size), f_(optionsOf(given, "files"))
    {
        require(model || size == 0, "model: expected bytes, found null");
    }

    // The caller's name, or a default chosen by the first bytes.
    const char* name() const
    {
        return f_.name ? f_.name : size_ >= 4 && std::memcmp(model_, "glTF", 4) == 0 ? "model.glb" : "model.gltf";
    }

    // The limits and functions for loading; they must not outlive this object.
    LoadLimits limits() const
    {
        LoadLimits limits;
        limits.pixels = Pixels::whereReadable;
        limits.sandbox = {};
        limits.readFile = [this, opened = false](const std::string& file) mutable -> Result<Bytes> {
            if (!std::exchange(opened, true)) // the first file is the model
                return copied(model_, size_);
            return read(file);
        };
        if (f_.decode)
            limits.decode = [this](std::span<const std::byte> bytes, const std::string& name) {
                return decode(bytes, name);
            };
        return limits;
    }

    std::function<Result<Bytes>(const Image&)> encoder() const
    {
        if (!f_.encode)
            return {};
        return [this](const Image& image) -> Result<Bytes> {
            const cotan_image_view view = imageViewOf(image);
            auto png = given([&](auto... bytes) { return f_.encode(f_.user, &view, bytes...); },
                             outputError(image.name + ": the caller did not encode the image"));
            if (png && !isPng(*png))
                return outputError(image.name + ": expected a PNG file of the caller, found other data");
            return png;
        };
    }

private:
    // Returns a copy of the bytes that a function of the caller sets; `error` if it sets none.
    Result<Bytes> given(const auto& function, Error error) const
    {
        const void* bytes = nullptr;
        std::size_t size = 0;
        const bool fine = function(&bytes, &size) == 0 && (bytes || size == 0);
        Result<Bytes> copy = fine ? Result<Bytes>(copied(bytes, size)) : Result<Bytes>(std::move(error));
        done();
        return copy;
    }

    Result<Bytes> read(const std::string& file) const
    {
        Error missing = inputError(file + ": there is no such file beside the model");
        if (!f_.read)
            return missing;
        return given([&](auto... bytes) { return f_.read(f_.user, file.c_str(), bytes...); }, std::move(missing));
    }

    Result<Image> decode(std::span<const std::byte> bytes, const std::string& name) const
    try {
        cotan_image_view view{};
        view.size = sizeof view;
        if (f_.decode(f_.user, name.c_str(), bytes.data(), bytes.size(), &view) != 0) {
            done();
            return inputError(name + ": the caller did not decode the image");
        }
        Image image = imageOf(&view, name.c_str());
        image.name = name;
        done();
        return image;
    } catch (const Error& error) {
        done();
        return error;
    }

    void done() const
    {
        if (f_.done)
            f_.done(f_.user);
    }

    const void* model_;
    std::size_t size_;
    cotan_model_files f_;
};

// The limits for max_degrees of an options struct, where 0 means the default.
inline ChoiceLimits choiceLimitsOf(double maxDegrees)
{
    require(maxDegrees >= 0 && maxDegrees <= 180, "options.max_degrees: expected 0 to 180");
    return maxDegrees > 0 ? ChoiceLimits::of(maxDegrees) : ChoiceLimits();
}

// format: as in files/json.hpp.
inline void giveText(std::string_view format, const Json& json, cotan_bytes** to)
{
    if (to)
        giveText(std::string_view(toText(versioned(format, json))), to);
}

} // namespace cotan::c
