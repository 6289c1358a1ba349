! RAPID Kernel, String literals: a string ends on its line.
MODULE string_end
  PROC main()
    TPWrite "never closed;
    ! error: E109
    TPWrite "closed";
  ENDPROC
ENDMODULE
