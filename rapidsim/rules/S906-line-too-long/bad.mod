! ---
MODULE near_miss
  PROC main()
    ! long long long long long long long long long long long long long long long long long long long long long long long long long long long long long long  ! found
    WaitTime 1;
  ENDPROC
ENDMODULE
