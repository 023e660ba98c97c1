// Messages of parts whose library is missing, from their replacement sources, which this build does not use otherwise.
#include <gtest/gtest.h>

#include "bake/high_surface.hpp"
#include "cotan/model.hpp"

namespace cotan {
namespace {

template<class T> void expectOneLine(const Result<T>& result, const std::string& line)
{
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::unavailable); // exit code 3
    EXPECT_EQ(result.error().message, line);
}

TEST(NotBuilt, errorNamesTheLibraryAndThePackage)
{
    expectOneLine(HighSurface::make({}, 1), "not built with Embree: install libembree-dev and build Cotan again");
    expectOneLine(loadWithAssimp("a/b.fbx"),
                  "a/b.fbx: not built with Assimp: install libassimp-dev and build Cotan again; or "
                  "convert the file to glTF or OBJ");
}

} // namespace
} // namespace cotan
