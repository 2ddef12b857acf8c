/// @file  For LD_PRELOAD: keeps libraries loaded, so that the leak checker can name them. Otherwise
/// OpenGL drivers are unloaded with the last window.

extern "C" int dlclose(void* /*library*/) { return 0; }
