// The files that Assimp may see.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <assimp/IOSystem.hpp>

#include "cotan/model.hpp"

namespace cotan {

// What was asked for while a model was read; outlives the file system that fills it.
struct FileRequests {
    std::vector<std::string> outside;  // refused: leads out of the model's folder
    std::vector<std::string> tooLarge; // refused: over the limit
};

// Serves the model itself from memory (as checked, not as it may have become on disk) and other
// files from the model's folder only. Read-only.
class ModelFiles : public Assimp::IOSystem {
public:
    // model: canonical path. Everything passed must outlive this.
    ModelFiles(const std::filesystem::path& model, std::span<const std::byte> modelBytes, const LoadLimits& limits,
               FileRequests& requests);

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

private:
    const std::filesystem::path& model_;
    std::filesystem::path folder_;
    std::span<const std::byte> bytes_;
    const LoadLimits& limits_;
    FileRequests& requests_;
};

} // namespace cotan
