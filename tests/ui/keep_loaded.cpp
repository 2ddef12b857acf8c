/// @file  To be preloaded: no library is unloaded, so that the leak checker can still name the one
/// that a leak belongs to. OpenGL's drivers are unloaded with the last window.

extern "C" int dlclose(void* /*library*/) { return 0; }
