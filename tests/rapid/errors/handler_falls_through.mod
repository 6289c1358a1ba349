! RAPID Kernel, Error recovery: an ERROR clause that comes to its end ends the routine.
MODULE handler_falls_through
  VAR num zero;

  PROC main()
    inner;
    TPWrite "after";                    ! -> after
  ENDPROC

  PROC inner()
    zero:=1/zero;
    TPWrite "never";
  ERROR
    TPWrite "noted";                    ! -> noted
  ENDPROC
ENDMODULE
