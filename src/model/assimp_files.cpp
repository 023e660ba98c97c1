#include "assimp_files.hpp"

#include <algorithm>
#include <string_view>

#include <assimp/MemoryIOWrapper.h>

#include "files/bytes.hpp"

namespace cotan {

namespace {

class BytesStream : public Assimp::MemoryIOStream {
public:
    explicit BytesStream(std::vector<std::byte> bytes)
        : MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), bytes_(std::move(bytes))
    {
    }

private:
    std::vector<std::byte> bytes_; // moving keeps the address
};

void addOnce(std::vector<std::string>& list, const std::string& text)
{
    if (std::ranges::find(list, text) == list.end())
        list.push_back(text);
}

} // namespace

ModelFiles::ModelFiles(const std::filesystem::path& model, std::span<const std::byte> modelBytes,
                       const LoadLimits& limits, FileRequests& requests)
    : model_(model), folder_(model.parent_path()), bytes_(modelBytes), limits_(limits), requests_(requests)
{
}

bool ModelFiles::Exists(const char* file) const
{
    bool outside = false;
    const bool found = file == model_ || findInFolder(folder_, file, outside).has_value();
    if (outside)
        addOnce(requests_.outside, file);
    return found;
}

Assimp::IOStream* ModelFiles::Open(const char* file, const char* mode)
{
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos)
        return nullptr;
    if (file == model_)
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
    bool outside = false;
    const auto found = findInFolder(folder_, file, outside);
    if (outside)
        addOnce(requests_.outside, file);
    if (!found)
        return nullptr;
    std::error_code error;
    if (std::filesystem::file_size(*found, error) > limits_.fileBytes) {
        addOnce(requests_.tooLarge, file);
        return nullptr;
    }
    auto bytes = readFileBytes(*found, limits_.fileBytes);
    if (!bytes)
        return nullptr;
    return new BytesStream(*std::move(bytes));
}

void ModelFiles::Close(Assimp::IOStream* stream) { delete stream; }

} // namespace cotan
