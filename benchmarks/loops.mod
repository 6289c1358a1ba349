MODULE Loops
  ! What `execution.py` measures: the lessons of programs/algorithms.mod, each often enough to time.

  VAR num shuffled{200};
  VAR num left_matrix{12,12};
  VAR num right_matrix{12,12};
  VAR num product_matrix{12,12};

  ! What the loops find: the ways of executing them must agree on it.
  VAR num found;
  VAR num sorted_list{200};
  VAR string text;
  VAR num pieces;
  VAR num value;
  VAR num longest;
  VAR num sum;

  PROC prepare()
    BookErrNo ERR_QUEUE_FULL;
    BookErrNo ERR_QUEUE_EMPTY;
    fill_list shuffled, 7;
    FOR row FROM 1 TO 12 DO
      FOR column FROM 1 TO 12 DO
        left_matrix{row,column}:=1/(row+column-1);
        right_matrix{row,column}:=row-column/10;
      ENDFOR
    ENDFOR
  ENDPROC

  PROC sieve()
    FOR turn FROM 1 TO 10 DO
      found:=count_primes();
    ENDFOR
  ENDPROC

  PROC insertion_sort()
    sorted_list:=shuffled;
    sort_by_insertion sorted_list;
  ENDPROC

  PROC quicksort()
    FOR turn FROM 1 TO 5 DO
      sorted_list:=shuffled;
      sort_by_parts sorted_list, 1, 200;
    ENDFOR
  ENDPROC

  PROC matrix_product()
    FOR turn FROM 1 TO 3 DO
      multiply left_matrix, right_matrix, product_matrix;
    ENDFOR
  ENDPROC

  PROC texts()
    FOR year FROM 1950 TO 2050 DO
      text:=roman(year);
    ENDFOR
    FOR turn FROM 1 TO 50 DO
      text:=packed(backwards("aaabccdddddeffggggh"));
    ENDFOR
  ENDPROC

  PROC records()
    VAR order next;

    pieces:=0;
    FOR turn FROM 1 TO 300 DO
      append ["gear",5,FALSE];
      append ["cover",2,TRUE];
      next:=first_order();
      next.pieces:=next.pieces+turn;
      pieces:=pieces+next.pieces;
      next:=first_order();
    ENDFOR
  ENDPROC

  PROC recursion()
    value:=fibonacci(16);
  ENDPROC

  PROC collatz()
    VAR num turns;

    longest:=0;
    FOR start FROM 1 TO 100 DO
      turns:=steps_to_one(start);
      IF turns>longest longest:=turns;
    ENDFOR
  ENDPROC

  PROC floats()
    sum:=0;
    FOR turn FROM 1 TO 10 DO
      sum:=sum+quarter_circle(200)+harmonic(300)+root_of(2);
    ENDFOR
  ENDPROC
ENDMODULE
