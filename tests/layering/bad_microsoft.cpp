// What check_microsoft has to refuse: a GNU extension, and a size that only other compilers give.
struct Empty {};
struct Holder {
    [[no_unique_address]] Empty nothing;
    int number;
};
static_assert(sizeof(Holder) == sizeof(int), "empty members take room");
int larger(int a, int b) {
    return ({ a > b ? a : b; });
}
