// Compiled once per macro by tests/core.cmake: only COTAN_MIX_NOTHING may succeed.
#include <cotan/frame.hpp>

using namespace cotan;

Vector3d tangent, bitangent;
Covector3d normal;

#if defined(COTAN_MIX_SUM)
// The function of the 2013 follow-up: a frame of tangent vectors and a normal covector is ill-formed.
Covector3d perturbNormal(double a, double b, double c) { return a * tangent + b * bitangent + c * normal; }
#elif defined(COTAN_MIX_ASSIGN)
Covector3d assigned = tangent;
#elif defined(COTAN_MIX_FRAME)
CotangentFrame<double> frame{tangent, bitangent, normal};
#elif defined(COTAN_MIX_DOT)
double number = dot(normal, normal);
#else
Covector3d cotangent, cobitangent;
Covector3d perturbNormal(double a, double b, double c) { return a * cotangent + b * cobitangent + c * normal; }
double pairing = dot(normal, tangent);
Covector3d plane = cross(tangent, bitangent);
CotangentFrame<double> frame{cotangent, cobitangent, normal};
#endif
