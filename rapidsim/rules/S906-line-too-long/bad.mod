! ---
MODULE near_miss
  PROC main()
    ! long long long long long long long long long long long long long long long long long long long long long long long long long long long long long long  ! found
    WaitTime 1;
  ENDPROC
ENDMODULE
! ---
MODULE first_line ! found long long long long long long long long long long long long long long long long long long long long long long long long
  PROC main()
    WaitTime 1;
  ENDPROC
ENDMODULE
