// Reports what to expect of a model without its tangents: lint FILE
#include <cstdio>

#include <cotan/lint.hpp>
#include <cotan/model.hpp>

int main(int argc, char** argv)
{
    const auto scene = cotan::loadScene(argc > 1 ? argv[1] : "");
    if (!scene)
        return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 2;
    std::printf("%s\n", cotan::lintScene(*scene).recommendation.c_str());
}
