// Not part of anything: shows check_symbols what it must find.
extern "C" float sinf(float);

int* allocates(float angle);
int* allocates(float angle) { return new int(static_cast<int>(sinf(angle))); }
