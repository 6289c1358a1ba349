! RAPID Kernel, Routine declarations: parentheses belong to PROC and FUNC even when empty.
MODULE heads
  PROC main                               ! error: E143
  ENDPROC

  LOCAL PROC hidden                       ! error: E143
  ENDPROC

  FUNC num half                           ! error: E143
    RETURN 0.5;
  ENDFUNC

  LOCAL FUNC num quarter                  ! error: E143
    RETURN 0.25;
  ENDFUNC
ENDMODULE
