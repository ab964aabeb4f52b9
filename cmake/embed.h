// Macros of the assembler for embedded files: the symbol `name` has the data between DATA(name) and
// END(name). In WebAssembly every symbol has its own section and its size.
#ifdef __wasm__
#define DATA(name) .section .rodata.name,"",@; .global name; .type name,@object; .p2align 2; name:
#define END(name) .L##name##_end: ; .size name, .L##name##_end - name
#else
#define DATA(name) .section .rodata; .global name; .balign 4; name:
#define END(name) .L##name##_end:
// The stack needs no permission to execute.
.section .note.GNU-stack,"",@progbits
#endif
