! RAPID Kernel, Alias types: another name for a type, but not for an alias.
MODULE aliases
  ALIAS num level;
  LOCAL ALIAS pos corner;
  ALIAS level height;             ! error: T319
ENDMODULE
