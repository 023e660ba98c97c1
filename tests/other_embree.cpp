// Stands for a program that has another version of Embree and exports its functions: each ends the program.
#include <cstdlib>

#define COTAN_OTHER(name)                                                                                              \
    extern "C" void name() { std::abort(); }
COTAN_OTHER(rtcAttachGeometry)
COTAN_OTHER(rtcCommitGeometry)
COTAN_OTHER(rtcCommitScene)
COTAN_OTHER(rtcGetDeviceError)
COTAN_OTHER(rtcIntersect1)
COTAN_OTHER(rtcIntersect16)
COTAN_OTHER(rtcNewDevice)
COTAN_OTHER(rtcNewGeometry)
COTAN_OTHER(rtcNewScene)
COTAN_OTHER(rtcOccluded1)
COTAN_OTHER(rtcPointQuery)
COTAN_OTHER(rtcReleaseDevice)
COTAN_OTHER(rtcReleaseScene)
