! RAPID Kernel, RAISE: an error of the controller may be raised by its name.
MODULE raise_predefined
  PROC main()
    RAISE ERR_WHLSEARCH;                ! stops: the program raised error ERR_WHLSEARCH
  ENDPROC
ENDMODULE
