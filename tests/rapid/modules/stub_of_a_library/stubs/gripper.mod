! Field practice, libraries: the headers of a library, and what its functions return.
MODULE gripper
  PROC Gripper_Close(num force)             ! warning: R104
  ENDPROC

  FUNC num Gripper_Width()                  ! warning: R104
    RETURN 40;
  ENDFUNC
ENDMODULE
