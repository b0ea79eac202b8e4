/* SPDX-License-Identifier: MIT */
/* The list of inputs that once failed. */
#include "inputs.h"

#include <stddef.h>

const struct input inputs[] = {
    {"ask", "carom_cast_mesh: a turn of INT32_MIN",
     "d0020100d0cececececececece0700000000007a00000e007a71252500710671252d7171d301cece0800cece0000"
     "000000ffffffffffffffff71257161ceff0100"},
    {"calls", "carom_cast_mesh: a way of 2^62 units",
     "00000000fcfcb20e0e0e41603d000000000000000001006040000b1a7690905b98aa3d30a60e60f060f02d00a00f"
     "60f00dac60f0a00f4a00a00fa00f00800e"},
    {"calls", "carom_contacts after a body of a contact was removed",
     "0385d32ba1834d020b50c311fd68a3c64d0fddf5a56c0462dba068c36048be749d7e4be212c844f790fa767792"
     "e809a14996160c7f1492d17f1da8aa0c379c579e0803cc7fd6e3aab3629734ab7eba8f7f3a0100434cf4b73a2e"
     "29f3b7ab30fa8ba1bedd923b83ca4e6b4834f77c3b1cff98805432d5a97b9eb9f3861e08df9396abcc14877060"
     "12510603d37f778844a4be3589ae1d9f336f817cb5e81591abf74a6870ae81a810e0b4c6cd6307455a5696c8fa"
     "c29ebfdd0d9406e85a9ad9a1eef461b9d229ca3485d91e317a440309af1dd9a1eef46113131313131313131313"
     "b4131313131313131313131313131313b9d229ca3429ca3485d91e317a440309af1dd9a1eef461131313131313"
     "13131313b4131313131313131313131313131313b9d229ca348536472766b05ec6588f8b42b86173f3f4a9de35"
     "8b891bb50d217593f9454a107084ebfb86d2a907ef06a28c3d10298f5ff9a21cfd4c9c5c8d5a71ae019c67004b"
     "2bce0708102978ff0db2c98913feca63b997540782516d8b7e1c7e8e0fe0bf4d57f20fa2b13ec63dfd600131f7"
     "7eef8bf9144da330496c0912feba14a779751922e4f7322f3c51f1da980f4b6f1a87b7bb63fdcf2f977cff1359"
     "681403ca6cbdad43f9bdbfb256c9fe5cf68237bfdbb5afb0d9c862561a82270bc547b39001a256a850397cbb"},
    {"calls", "the place of a spring of a joint that has none, 2^63 units",
     "09e5d43242ede4cb66a00239e6a29aaed84d8b9c31310f31cfd1fec7d1fcffff0e003434343434343430303030"
     "303030303030303030313631323635383431343739373460f060f0ae00a00f60f0310160f0a00f0500a00fa00f"
     "0200313435383230000000000000003b3431373230353830313335b434c2cf30303030ffff30"},
    {"mesh",
     "a mesh with a part inside out, whose moments no solid has: the path of its spin left 64 bits",
     "80611ac3762f2c2c6e4365539de530ceaccbb5ac8d08ca36a1227d059428395553685d4b5d0b796fa6494efee3"
     "a1e530ce3de9723823c7fd388461ca61cd2e04c19dc6ebb7ab0dacc5c5e4893de9723823c78fa32eda9710a182"},
    {"snapshot", "a kept impulse above 2^40 units left the friction cone",
     "baad08d1ab21fbfbfbfbfbfbfbfbfbfbfbfb72eb6e29010000000000000100000000000001000000010000af00c"
     "a"},
    {"snapshot", "a jointed body out of range set out with its group's slice",
     "d207f39cfcfcfcfcfcfcfcfc2e2326fcfcfcfcfcfcfcfcfc21fc811032238fc32019af2393beb9db40bf2dca47"
     "9515cb9480ca479555cb948003502c1e"},
    {NULL, NULL, NULL}, /* the end */
};
