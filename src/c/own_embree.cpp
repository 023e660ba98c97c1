// Calls the Embree that libcotan was linked with, also in a program that has another. Blender does: it exports Embree
// 4, whose functions have the names of Embree 3 and other parameters, and the dynamic linker takes a program's
// functions first. Each function here has Embree's name, is local to libcotan, and jumps to the address that is found
// among the libraries of libcotan alone when it is loaded.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

#define COTAN_EMBREE(each)                                                                                             \
    each(rtcAttachGeometry) each(rtcCommitGeometry) each(rtcCommitScene) each(rtcGetDeviceError) each(rtcIntersect1)   \
        each(rtcIntersect16) each(rtcNewDevice) each(rtcNewGeometry) each(rtcNewScene) each(rtcOccluded1)              \
            each(rtcOccluded16) each(rtcPointQuery) each(rtcReleaseDevice) each(rtcReleaseGeometry)                    \
                each(rtcReleaseScene) each(rtcSetSceneFlags) each(rtcSetSharedGeometryBuffer)

#define COTAN_ADDRESS(name) __attribute__((visibility("hidden"))) void* cotan_address_of_##name;
#define COTAN_JUMP(name)                                                                                               \
    asm(".pushsection .text\n.globl " #name "\n.hidden " #name "\n.type " #name ", @function\n" #name                  \
        ": endbr64\njmp *cotan_address_of_" #name "(%rip)\n.size " #name ", . - " #name "\n.popsection");
extern "C" {
COTAN_EMBREE(COTAN_ADDRESS)
void rtcRetainDevice();
// A function that nobody calls makes the linker keep Embree's library.
__attribute__((used, visibility("hidden"))) void* cotan_keeps_embree = reinterpret_cast<void*>(&rtcRetainDevice);
}
COTAN_EMBREE(COTAN_JUMP)

namespace {

__attribute__((constructor)) void findEmbree()
{
    Dl_info here{};
    dladdr(reinterpret_cast<void*>(&findEmbree), &here);
    void* const libcotan = dlopen(here.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
#define COTAN_FIND(name)                                                                                               \
    cotan_address_of_##name = libcotan == nullptr ? nullptr : dlsym(libcotan, #name);                                  \
    if (cotan_address_of_##name == nullptr) {                                                                          \
        std::fputs("libcotan: expected " #name " in the library of Embree\n", stderr);                                 \
        std::abort();                                                                                                  \
    }
    COTAN_EMBREE(COTAN_FIND)
}

} // namespace
