MODULE example
  PROC main()
    WaitTime 1;
  ENDPROC
  FUNC num doubled(num x) ! found
    RETURN 2*x;
  ENDFUNC
ENDMODULE
! ---
MODULE bad
  PROC main()
    WaitTime 1;
  ENDPROC
  FUNC num doubled(num x)     ! found
    RETURN 2*x;
  ENDFUNC
  PROC with_parameter(num x)  ! found
    WaitTime x;
  ENDPROC
  LOCAL PROC of_module()      ! found
    WaitTime 1;
  ENDPROC
  FUNC num itself(num n)      ! found
    IF n<1 RETURN 0;
    RETURN itself(n-1);
  ENDFUNC
  TRAP unconnected            ! found
    TPErase;
  ENDTRAP
ENDMODULE
